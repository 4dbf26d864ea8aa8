/// A CAN interface through SocketCAN: sends, retries what the queue did not take, counts errors.
///
/// The interface may be absent or down: it is tried again every second, and state() says why.
/// Receives nothing but error frames. Its functions never block and never throw.
///
/// Memory:
///   kMaxPending frames in place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/can_frame.hpp"
#include "core/fixed_queue.hpp"

namespace plumb {

struct SocketCanCounters {
  std::int64_t num_sent = 0;     ///< frames that the kernel took
  std::int64_t num_retried = 0;  ///< frames it took after it had refused them (ENOBUFS, EAGAIN)
  std::int64_t num_unsent = 0;   ///< frames given up: too old, queue full, interface down
  std::int64_t num_opened = 0;   ///< times the interface came up
  std::int64_t num_errors = 0;   ///< error frames received; the next three count kinds of them
  std::int64_t num_bus_off = 0;  ///< the controller went bus-off
  std::int64_t num_passive = 0;  ///< the controller is error passive or warns
  std::int64_t num_unacked = 0;  ///< nobody acknowledged a frame
};

class SocketCan final : public CanSink {
 public:
  static constexpr std::size_t kMaxPending = 64;
  static constexpr std::int64_t kMaxPendingUs = 50'000;  ///< an older frame is given up
  static constexpr std::int64_t kReopenUs = 1'000'000;

  /// Socket for an interface, or -1 and one sentence why. Tests bring their own.
  using Opener = int (*)(const std::string& interface, std::string* why);
  static int open_raw(const std::string& interface, std::string* why);

  explicit SocketCan(const std::string& interface, Opener opener = &SocketCan::open_raw);
  ~SocketCan() override;
  SocketCan(const SocketCan&) = delete;
  SocketCan& operator=(const SocketCan&) = delete;

  /// Opens when it is time to, reads error frames, retries. Call before every burst.
  void service(std::int64_t now_us);
  void send(std::int64_t time_us, const CanFrame& frame) override;

  [[nodiscard]] bool is_up() const { return fd_ >= 0; }
  /// One sentence; empty while all is well.
  [[nodiscard]] const std::string& state() const { return state_; }
  [[nodiscard]] const SocketCanCounters& counters() const { return counters_; }

 private:
  enum class Result { kSent, kBusy, kDown };
  struct Pending {
    std::int64_t time_us = 0;
    CanFrame frame;
  };

  Result write(const CanFrame& frame);
  void read_errors();
  void retry(std::int64_t now_us);
  void go_down(int error_number);

  std::string interface_;
  Opener opener_;
  int fd_ = -1;
  std::int64_t next_open_us_ = INT64_MIN;
  std::string state_;
  FixedQueue<Pending, kMaxPending> pending_;
  SocketCanCounters counters_;
};

}  // namespace plumb
