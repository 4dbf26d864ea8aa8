/// A loop that waits for descriptors, timers and the two stop signals.
///
/// Threads:
///   One thread owns the loop; every callback runs in it.
///   No function may be called from another thread.
/// Order:
///   Each round serves every ready source once,
///   so that a flood on one source cannot starve a timer.
/// Memory:
///   Sources are registered before run(). Nothing is allocated while it runs.
/// Errors:
///   Functions throw std::system_error when the system refuses a descriptor or a call. An exception
///   that a callback throws leaves run() or step().
#pragma once

#include <poll.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace plumb {

/// Blocks SIGINT and SIGTERM for this thread and for the threads that it starts later. An EventLoop
/// receives the signals, also those that arrived before its construction.
void block_stop_signals();

class EventLoop {
 public:
  using Callback = std::function<void()>;
  using TimerId = std::size_t;

  /// Blocks the stop signals and receives them. Throws std::system_error when the system has no
  /// descriptors left.
  EventLoop();
  ~EventLoop();
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  /// Runs `callback` whenever `fd` is readable or has failed. The caller keeps the descriptor and
  /// closes it after the loop.
  void watch(int fd, Callback callback);
  /// Runs `callback` every `period_us` without drift.
  /// It runs once for all periods that were missed.
  TimerId every(std::int64_t period_us, Callback callback);
  /// Creates a timer that is not armed.
  TimerId timer(Callback callback);
  /// Makes the timer fire once at the time `at_us` of monotonic_us(),
  /// or at once when that has passed.
  void arm_at(TimerId timer, std::int64_t at_us);
  void disarm(TimerId timer);

  /// Serves the sources until stop() or a stop signal.
  void run();
  /// Serves one round after waiting up to `timeout_ms` for it (-1: for ever). Returns false when
  /// the loop is to end.
  bool step(int timeout_ms);
  void stop() { stopped_ = true; }
  /// SIGINT or SIGTERM, or 0 when no stop signal arrived.
  [[nodiscard]] int stop_signal() const { return stop_signal_; }

 private:
  struct Source {
    bool is_timer;
    Callback callback;
  };
  std::size_t add(int fd, bool is_timer, Callback callback);
  void set_timer(TimerId timer, std::int64_t at_us, std::int64_t period_us);

  std::vector<pollfd> polls_;  ///< indexed like sources_
  std::vector<Source> sources_;
  bool stopped_ = false;
  int stop_signal_ = 0;
};

}  // namespace plumb
