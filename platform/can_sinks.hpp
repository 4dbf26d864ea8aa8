/// The bus and the trace of plumb-can, either of which may be missing, and what is wrong with them.
///
/// Its functions never wait: SocketCan keeps what the bus does not take, CanTraceThread what the
/// disk does not.
///
/// Memory:
///   That of its parts, and a sentence.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "platform/can_trace_thread.hpp"
#include "platform/socket_can.hpp"

namespace plumb {

class CanSinks final : public CanSink {
 public:
  /// Opens what has a name. `offset_us` turns the clock of send() into calendar time. Returns why
  /// the trace cannot be written; empty without a failure.
  const std::string& open(const std::string& interface, const std::string& trace_path,
                          std::int64_t offset_us, SocketCan::Opener opener = &SocketCan::open_raw);

  /// Before every burst.
  void service(std::int64_t now_us);
  void send(std::int64_t time_us, const CanFrame& frame) override;
  /// Writes the rest of the trace. Returns whether all of it is in the file.
  bool close() { return !trace_ || trace_->close(); }

  [[nodiscard]] std::int64_t num_sent() const;
  /// Frames that the bus did not take.
  [[nodiscard]] std::int64_t num_unsent() const;
  /// Frames that the trace had no room for.
  [[nodiscard]] std::int64_t num_dropped() const { return trace_ ? trace_->num_dropped() : 0; }
  [[nodiscard]] const std::string& trace_error() const;
  [[nodiscard]] bool has_bus() const { return bus_.has_value(); }
  /// Whether no frame can be written anywhere any more.
  [[nodiscard]] bool is_useless() const { return !bus_ && !trace_error().empty(); }
  /// What is wrong, the bus first; empty while all is well.
  [[nodiscard]] const char* trouble() const { return trouble_.data(); }
  /// Whether service() has changed the sentence.
  [[nodiscard]] bool trouble_changed() const { return trouble_changed_; }

 private:
  void write_trouble(std::int64_t now_us);

  std::optional<SocketCan> bus_;
  std::optional<CanTraceThread> trace_;
  std::string trace_path_;
  std::string nothing_;
  std::array<char, 320> trouble_{};
  bool trouble_changed_ = false;
  std::int64_t told_dropped_ = 0;
  std::int64_t drop_told_us_ = 0;
};

}  // namespace plumb
