/// One thread that waits for descriptors, timers and the two stop signals.
///
/// Order    everything that is ready is served once per round, so a flood on one source cannot
/// starve a timer. Memory   sources are registered before run(); nothing is allocated while it
/// runs.
#pragma once

#include <poll.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace plumb {

/// Blocks SIGINT and SIGTERM for this thread and those it starts later: an EventLoop takes them, also
/// those that came before it was made.
void hold_stop_signals();

class EventLoop {
 public:
  using Callback = std::function<void()>;
  using TimerId = std::size_t;

  /// Holds the stop signals. Throws std::system_error when the system has no descriptors left.
  EventLoop();
  ~EventLoop();
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;

  /// `callback` runs whenever `fd` is readable (or has failed). The descriptor stays the caller's.
  void watch(int fd, Callback callback);
  /// `callback` runs every `period_us`, without drift; periods that were missed run once.
  TimerId every(std::int64_t period_us, Callback callback);
  /// A timer that rests until it is armed.
  TimerId timer(Callback callback);
  /// The timer fires once at `at_us` of monotonic_us(), at once when that has passed.
  void arm_at(TimerId timer, std::int64_t at_us);
  void disarm(TimerId timer);

  /// Serves until stop() or a stop signal.
  void run();
  /// One round, waiting up to `timeout_ms` (-1: for ever). False when the loop is to end.
  bool step(int timeout_ms);
  void stop() { stopped_ = true; }
  /// [us] monotonic time since which something has been ready without pause: nothing served now has waited longer.
  [[nodiscard]] std::int64_t busy_since_us() const { return busy_since_us_; }
  /// SIGINT or SIGTERM, 0 when none came.
  [[nodiscard]] int stop_signal() const { return stop_signal_; }

 private:
  struct Source {
    bool is_timer;
    Callback callback;
  };
  int wait(int timeout_ms);
  std::size_t add(int fd, bool is_timer, Callback callback);
  void set_timer(TimerId timer, std::int64_t at_us, std::int64_t period_us);

  std::vector<pollfd> polls_;  ///< same index as sources_
  std::vector<Source> sources_;
  bool stopped_ = false;
  int stop_signal_ = 0;
  std::int64_t busy_since_us_ = 0;
};

}  // namespace plumb
