#include "modules/camera/pacing.hpp"

#include <algorithm>
#include <cmath>

namespace plumb {

std::int64_t Pacer::due_us(std::int64_t capture_us, std::int64_t now_us) {
  if (!anchored_) {
    anchored_ = true;
    first_capture_us_ = capture_us;
    first_due_us_ = now_us;
  }
  if (speed_ == 0.0) return now_us;
  const double since_first_us = static_cast<double>(capture_us - first_capture_us_) / speed_;
  return first_due_us_ + std::llround(since_first_us);
}

std::int64_t SequenceTracker::next(std::uint32_t driver_sequence) {
  std::int64_t step = 1;
  if (has_last_) {
    // The difference is modulo 2^32, so the wrap is an ordinary step. A difference in the upper
    // half is a step back.
    const std::uint32_t ahead = driver_sequence - last_driver_;
    constexpr std::uint32_t kHalf = 1U << 31;
    if (ahead != 0 && ahead < kHalf) step = ahead;
  }
  has_last_ = true;
  last_driver_ = driver_sequence;
  num_missing_ += step - 1;
  seq_ += step;
  return seq_;
}

void SequenceTracker::restart(std::int64_t num_missed) {
  if (!has_last_) return;
  has_last_ = false;
  const std::int64_t missed = std::max<std::int64_t>(num_missed, 0);
  num_missing_ += missed;
  seq_ += missed;
}

std::int64_t BackOff::next_us() {
  pause_us_ = pause_us_ == 0 ? min_us_ : std::min(2 * pause_us_, std::max(min_us_, max_us_));
  return pause_us_;
}

}  // namespace plumb
