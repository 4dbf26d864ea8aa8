/// Writes LCM messages to a log file.
///
/// Errors:
///   Functions throw LogError.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/channels.hpp"
#include "platform/log_file.hpp"

namespace plumb {

class MessageLog {
 public:
  /// Creates or replaces the file.
  explicit MessageLog(const std::string& path) : log_(path) {}

  /// Appends one message at the time `log_us`.
  template <typename Message>
  void write(std::int64_t log_us, const Channel& channel, const Message& message) {
    const int size = message.getEncodedSize();
    buffer_.resize(static_cast<std::size_t>(size));
    message.encode(buffer_.data(), 0, size);
    log_.write(log_us, channel.name, buffer_);
  }

  /// Passes everything written to the system and closes the file.
  void close() { log_.close(); }

 private:
  LogWriter log_;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace plumb
