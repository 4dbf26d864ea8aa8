/// Reads the frames that plumb-can sends, without sending any: from a SocketCAN interface, or from
/// the trace file while it is written.
///
/// Memory:
///   One buffer; a line of a trace that does not fit is left out and counted.
/// Errors:
///   An interface that is down and a file that does not exist yet are tried again every second;
///   state() says why there is nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/can_frame.hpp"

namespace plumb {

class CanFeed {
 public:
  using Sink = std::function<void(const CanFrame&)>;

  /// At most one of `interface` and `trace` is not empty.
  CanFeed(std::string interface, std::string trace, Sink sink);
  ~CanFeed();
  CanFeed(const CanFeed&) = delete;
  CanFeed& operator=(const CanFeed&) = delete;

  /// Passes on what has come. Never waits. A trace that exists when it is opened is read from its
  /// end, and one that was cut short or replaced from its beginning.
  void poll(std::int64_t now_us);
  /// One sentence why there are no frames; empty while there may be some.
  [[nodiscard]] const std::string& state() const { return state_; }
  [[nodiscard]] bool wanted() const { return !interface_.empty() || !trace_.empty(); }
  [[nodiscard]] std::int64_t num_unreadable() const { return num_unreadable_; }

 private:
  static constexpr std::int64_t kReopenUs = 1'000'000;
  static constexpr std::size_t kMaxLineBytes = 512;
  static constexpr std::int64_t kMaxBytesPerPoll = 1 << 20;

  void open(std::int64_t now_us);
  void open_interface();
  void open_trace();
  void close_descriptor();
  void read_interface();
  void read_trace();
  void take_characters(const char* text, std::size_t count);
  [[nodiscard]] bool is_replaced() const;

  std::string interface_;
  std::string trace_;
  Sink sink_;
  int fd_ = -1;
  bool was_open_ = false;
  std::int64_t next_open_us_ = INT64_MIN;
  std::int64_t offset_ = 0;
  std::string line_;
  bool line_too_long_ = false;
  std::int64_t num_unreadable_ = 0;
  std::string state_;
};

}  // namespace plumb
