/// Hands messages from the thread that receives them to the one that writes them, in memory that is
/// fixed.
///
/// Threads:
///   One thread calls push(), another one pop(); close() may be called from any.
/// Memory:
///   One block of bytes, taken in the constructor.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace plumb {

class MessageRing {
 public:
  struct Message {
    int channel = 0;
    std::int64_t log_us = 0;
    std::vector<std::uint8_t> bytes;
  };

  explicit MessageRing(std::size_t num_bytes) : bytes_(num_bytes) {}

  /// Waits for room. Returns false when the ring was closed meanwhile.
  /// @pre the message and 24 bytes fit into the ring
  bool push(int channel, std::int64_t log_us, std::span<const std::uint8_t> message);
  enum class Result { kMessage, kNothing, kClosed };
  /// Waits up to `timeout_ms` for a message. After close() it first gives what is left.
  [[nodiscard]] Result pop(Message* message, int timeout_ms);
  void close();

  /// [bytes] The fullest that it ever was.
  [[nodiscard]] std::size_t peak_bytes() const;
  [[nodiscard]] std::size_t size_bytes() const { return bytes_.size(); }

 private:
  struct Header {
    std::int64_t log_us;
    std::uint64_t size;
    std::int64_t channel;
  };
  void copy_in(const void* from, std::size_t count);
  void copy_out(void* to, std::size_t count);

  std::vector<std::uint8_t> bytes_;
  std::size_t begin_ = 0;
  std::size_t used_ = 0;
  std::size_t peak_ = 0;
  bool closed_ = false;
  mutable std::mutex mutex_;
  std::condition_variable has_room_;
  std::condition_variable has_message_;
};

}  // namespace plumb
