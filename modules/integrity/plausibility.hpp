/// Whether a metric motion and a ground plane can be those of a road vehicle, signal by signal.
///
/// Three kinds of checks: ranges, the change from the last believed value (SignalGuard), and
/// consistency of signals of one image: the step against speed and interval, the turn against the
/// yaw rate, the distance against the step, lateral acceleration. A signal that is not valid must
/// be sent as "not available". Each becomes valid again after `recover_images` good ones, at the
/// latest `reestablish_s` after it has become steady.
///
/// Frames:
///   ground: x forward, y left, z up.
/// Units:
///   SI.
/// Memory:
///   A few numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/numbers.hpp"
#include "modules/integrity/plausibility_config.hpp"
#include "modules/integrity/signal_guard.hpp"

namespace plumb {

enum class VehicleSignal : std::uint8_t {
  kSpeed = 0,
  kAcceleration,
  kYawRate,
  kPose,  ///< integrated position, heading and distance
  kHeight,
  kPitch,
  kRoll,
};
inline constexpr std::size_t kNumVehicleSignals = 7;

/// One image's metric motion and plane. NaN: not available.
struct VehicleMotion {
  double interval_s = kNan;  ///< from the previous sample; NaN when TimeBase does not vouch for it
  double speed_m_s = kNan;   ///< forward
  double speed_std_m_s = 0.0;
  double accel_m_s2 = kNan;
  double yaw_rate_rad_s = kNan;
  double step_m = kNan;      ///< length of the motion over the interval
  double turn_rad = kNan;    ///< rotation about the vertical over the interval
  double distance_m = kNan;  ///< path length so far
  double log_scale = kNan;   ///< logarithm of metres per unit of VO
  double height_m = kNan;
  double pitch_rad = kNan;
  double roll_rad = kNan;
  /// The pose or VO's unit began anew with this image: distance and scale may jump.
  bool is_reset = false;
};

class PlausibilityVerdict {
 public:
  [[nodiscard]] PlausibilityReason operator[](VehicleSignal signal) const {
    return reasons_[static_cast<std::size_t>(signal)];
  }
  PlausibilityReason& operator[](VehicleSignal signal) {
    return reasons_[static_cast<std::size_t>(signal)];
  }
  [[nodiscard]] bool is_valid(VehicleSignal signal) const {
    return (*this)[signal] == PlausibilityReason::kNone;
  }
  /// The signal with this image is believed again, at a value that the earlier one does not lead
  /// to. Whoever integrates must count a reset.
  bool must_reset = false;

 private:
  std::array<PlausibilityReason, kNumVehicleSignals> reasons_{};
};

/// One short clause for logs and health; "" for kNone.
[[nodiscard]] const char* describe(PlausibilityReason reason);

class Plausibility {
 public:
  explicit Plausibility(const PlausibilityConfig& config);

  PlausibilityVerdict update(const VehicleMotion& motion);

  /// Believes nothing any more.
  void reset();

 private:
  void judge_speed(const VehicleMotion& motion, PlausibilityVerdict* verdict);
  void judge_yaw_rate(const VehicleMotion& motion, PlausibilityVerdict* verdict);
  void judge_acceleration(const VehicleMotion& motion, PlausibilityVerdict* verdict) const;
  void judge_pose(const VehicleMotion& motion, PlausibilityVerdict* verdict);
  void judge_plane(const VehicleMotion& motion, PlausibilityVerdict* verdict);
  [[nodiscard]] bool interval_plausible(double interval_s) const;

  PlausibilityConfig config_;
  SignalGuard speed_;
  SignalGuard yaw_rate_;
  SignalGuard log_scale_;
  SignalGuard log_height_;
  SignalGuard pitch_;
  SignalGuard roll_;
  double last_distance_m_ = kNan;
};

}  // namespace plumb
