/// Ages on a clock that may have been set in between.
#pragma once

#include <cstdint>

#include "core/numbers.hpp"

namespace plumb {

/// Returns the age of `then_us`; it is never negative, and INT64_MAX when the clock went backwards.
[[nodiscard]] constexpr std::int64_t age_us(std::int64_t now_us, std::int64_t then_us) {
  if (now_us < then_us) return INT64_MAX;
  const auto age = static_cast<std::uint64_t>(now_us) - static_cast<std::uint64_t>(then_us);
  return age > static_cast<std::uint64_t>(INT64_MAX) ? INT64_MAX : static_cast<std::int64_t>(age);
}

enum class AgeState : std::int8_t {
  kFresh,
  kTooOld,
  kUnknown,  ///< the capture time is not known, or lies ahead
};

/// A capture time may lie this far ahead: two clocks are compared by estimation.
inline constexpr std::int64_t kMaxAheadUs = 20'000;

/// Returns the time since the capture of an image; -1 when it is not known. `capture_us` is 0 while
/// the sender does not know it.
[[nodiscard]] constexpr std::int64_t capture_age_us(std::int64_t now_us, std::int64_t capture_us) {
  if (capture_us == 0) return -1;
  if (now_us >= capture_us) return age_us(now_us, capture_us);
  return age_us(capture_us, now_us) <= kMaxAheadUs ? 0 : -1;
}

[[nodiscard]] constexpr AgeState judge_age(std::int64_t now_us, std::int64_t capture_us,
                                           std::int64_t stale_us) {
  const std::int64_t age = capture_age_us(now_us, capture_us);
  if (age < 0) return AgeState::kUnknown;
  return age > stale_us ? AgeState::kTooOld : AgeState::kFresh;
}

/// The age [s] as a signal carries it; NaN while it is not known.
[[nodiscard]] constexpr double age_signal_s(std::int64_t now_us, std::int64_t capture_us) {
  const std::int64_t age = capture_age_us(now_us, capture_us);
  return age < 0 ? kNan : static_cast<double>(age) * 1e-6;
}

}  // namespace plumb
