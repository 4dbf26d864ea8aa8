/// What the CAN gates tell of themselves and of the chain: the sources of signals that come from no
/// message.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace plumb {

inline constexpr double kNotAvailable = std::numeric_limits<double>::quiet_NaN();

/// What a receiver may do with the values beside it. All ones, not available: nothing was received,
/// it is too old, or its age is not known.
enum class CanValidity : std::int8_t {
  kInvalid = 0,   ///< the source answers, but its values are not valid: sent as not available
  kDegraded = 1,  ///< predicted; the standard deviation says how accurate the values are
  kValid = 2,
};
inline constexpr std::array<const char*, 3> kValidityNames = {"invalid", "degraded", "valid"};

/// State of the whole chain.
enum class CanMode : std::int8_t {
  kNoInput = 0,
  kInitializing = 1,
  kNormal = 2,
  kDegraded = 3,
  kFailed = 4,
  kTooOld = 5,      ///< there is input, but its image was taken too long ago
  kAgeUnknown = 6,  ///< there is input, but when its image was taken is not known or lies ahead
};
inline constexpr std::array<const char*, 7> kModeNames = {
    "no_input", "initializing", "normal", "degraded", "failed", "too_old", "age_unknown"};

struct CanState {
  CanMode mode = CanMode::kNoInput;
  std::int64_t num_missed = 0;      ///< camera frames missing by seq
  std::int64_t num_overflowed = 0;  ///< camera frames dropped because the queue was full
  std::int64_t num_rejected = 0;    ///< messages that broke their contract
  std::int64_t num_unsent = 0;      ///< frames that the bus did not take
  double uptime_s = 0.0;            ///< whole seconds since the first tick
  double age_s = kNotAvailable;     ///< of the newest camera frame, since its capture
  std::uint32_t start = 0;          ///< differs from one run of plumb-can to the next
};

inline constexpr std::size_t kMaxCanObjects = 8;

/// A list of objects as a whole.
struct CanObjectCounts {
  std::size_t num_objects = 0;    ///< sent
  std::int64_t num_left_out = 0;  ///< not sent: further away, or without a place on the road
  double age_s = kNotAvailable;   ///< since the capture of the frame that was searched
};

}  // namespace plumb
