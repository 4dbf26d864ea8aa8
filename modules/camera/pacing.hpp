/// When a recorded frame is due, and what a live camera's frame counter means. Pure functions of
/// times.
///
/// Units    [us] everywhere; `now_us` is any monotonic clock of the caller.
/// Memory   a few numbers.
#pragma once

#include <cstdint>

namespace plumb {

/// Replays recorded times at `speed` times their pace. The schedule is anchored once, at the first
/// frame, and never moved: a slow reader catches up, and the average pace holds. No frame is
/// skipped.
class Pacer {
 public:
  /// @pre speed >= 0; 0 is as fast as it goes
  explicit Pacer(double speed) : speed_(speed) {}

  /// Time on the caller's clock at which the frame captured at `capture_us` is to be published.
  /// The first call anchors the schedule at `now_us`.
  [[nodiscard]] std::int64_t due_us(std::int64_t capture_us, std::int64_t now_us);

 private:
  double speed_;
  bool anchored_ = false;
  std::int64_t first_capture_us_ = 0;
  std::int64_t first_due_us_ = 0;
};

/// Turns the driver's 32-bit frame counter into a sequence number that survives wrap and restart.
class SequenceTracker {
 public:
  /// Sequence number of the frame; +1 plus one per frame the driver dropped.
  /// A counter that stands still or steps back counts as +1: some drivers do not keep one.
  [[nodiscard]] std::int64_t next(std::uint32_t driver_sequence);

  /// The device was opened again: its counter starts over. `num_missed` frames are thought lost.
  void restart(std::int64_t num_missed);

  /// Frames missing so far by the driver's counter, restarts included.
  [[nodiscard]] std::int64_t num_missing() const { return num_missing_; }

 private:
  bool has_last_ = false;
  std::uint32_t last_driver_ = 0;
  std::int64_t seq_ = -1;
  std::int64_t num_missing_ = 0;
};

/// Pause before the n-th attempt to open a lost device: min, 2 min, 4 min ... max.
class BackOff {
 public:
  /// @pre 0 < min_us
  BackOff(std::int64_t min_us, std::int64_t max_us) : min_us_(min_us), max_us_(max_us) {}

  /// The pause before the next attempt.
  [[nodiscard]] std::int64_t next_us();
  /// An attempt succeeded.
  void reset() { pause_us_ = 0; }

 private:
  std::int64_t min_us_;
  std::int64_t max_us_;
  std::int64_t pause_us_ = 0;
};

}  // namespace plumb
