/// Schedules the frames of a recording, numbers the frames of a live camera and spaces the attempts
/// to open a lost device.
///
/// Units:
///   Times are in microseconds; `now_us` is any monotonic clock of the caller.
/// Memory:
///   A few numbers.
#pragma once

#include <cstdint>

namespace plumb {

/// Schedules recorded frames at `speed` times their original rate. The schedule is anchored at the
/// first frame and never moved, so that a slow reader catches up and the average rate is kept. No
/// frame is skipped.
class Pacer {
 public:
  /// With a speed of 0 every frame is due at once.
  /// @pre speed >= 0
  explicit Pacer(double speed) : speed_(speed) {}

  /// Time on the caller's clock at which the frame captured at `capture_us` is due. The first call
  /// anchors the schedule at `now_us`.
  [[nodiscard]] std::int64_t due_us(std::int64_t capture_us, std::int64_t now_us);

 private:
  double speed_;
  bool anchored_ = false;
  std::int64_t first_capture_us_ = 0;
  std::int64_t first_due_us_ = 0;
};

/// Turns the driver's 32-bit frame counter into a sequence number that continues after a wrap and
/// after a restart.
class SequenceTracker {
 public:
  /// Sequence number of the next frame: one more than the last, plus one per frame that the driver
  /// dropped. A counter that stands still or steps back counts as one step,
  /// because some drivers do not count.
  [[nodiscard]] std::int64_t next(std::uint32_t driver_sequence);

  /// Tells that the device was opened again, so that its counter restarts.
  /// `num_missed` frames are assumed lost.
  void restart(std::int64_t num_missed);

  /// Number of frames missing so far, including those lost at restarts.
  [[nodiscard]] std::int64_t num_missing() const { return num_missing_; }

 private:
  bool has_last_ = false;
  std::uint32_t last_driver_ = 0;
  std::int64_t seq_ = -1;
  std::int64_t num_missing_ = 0;
};

/// The pauses before attempts to open a lost device: min, 2 min, 4 min and so on up to max.
class BackOff {
 public:
  /// @pre 0 < min_us
  BackOff(std::int64_t min_us, std::int64_t max_us) : min_us_(min_us), max_us_(max_us) {}

  /// The pause before the next attempt.
  [[nodiscard]] std::int64_t next_us();
  /// Tells that an attempt succeeded; the next pause is min again.
  void reset() { pause_us_ = 0; }

 private:
  std::int64_t min_us_;
  std::int64_t max_us_;
  std::int64_t pause_us_ = 0;
};

}  // namespace plumb
