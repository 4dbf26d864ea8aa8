#include "modules/integrity/plausibility.hpp"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Measurement noise that the comparisons allow.
constexpr double kSpeedSlackMS = 0.5;
constexpr double kYawSlackRadS = 0.08;
constexpr double kScaleSlack = 0.05;
constexpr double kHeightSlack = 0.15;
constexpr double kTiltSlackRad = 0.03;
/// Two figures for one motion: relative and absolute difference.
constexpr double kStepShare = 0.1;
constexpr double kStepSlackM = 0.03;
constexpr double kTurnSlackRad = 0.01;

GuardLimits symmetric(double limit, double rate, double sustained, double slack) {
  return {-limit, limit, rate, sustained, slack};
}

/// Whether both are known and differ by more than noise.
bool contradict(double a, double b, double slack) {
  if (std::isnan(a) || std::isnan(b)) return false;
  return std::abs(a - b) > slack + kStepShare * std::max(std::abs(a), std::abs(b));
}

}  // namespace

const char* describe(PlausibilityReason reason) {
  switch (reason) {
    case PlausibilityReason::kNone:
      return "";
    case PlausibilityReason::kNotMeasured:
      return "it is not measured";
    case PlausibilityReason::kOutOfRange:
      return "it is beyond what a road vehicle does";
    case PlausibilityReason::kTooFast:
      return "it changes faster than a road vehicle can";
    case PlausibilityReason::kRecovering:
      return "it has not been plausible for long enough";
    case PlausibilityReason::kInterval:
      return "the time between the images is not plausible";
    case PlausibilityReason::kInconsistent:
      return "it contradicts another signal";
    case PlausibilityReason::kDependent:
      return "a signal that it depends on is not valid";
  }
  return "";
}

Plausibility::Plausibility(const PlausibilityConfig& c)
    : config_(c),
      speed_(
          symmetric(c.max_speed_m_s, c.max_accel_m_s2, c.max_sustained_accel_m_s2, kSpeedSlackMS),
          c.recover_images, c.reestablish_s),
      yaw_rate_(symmetric(c.max_yaw_rate_rad_s, c.max_yaw_accel_rad_s2, c.max_yaw_accel_rad_s2,
                          kYawSlackRadS),
                c.recover_images, c.reestablish_s),
      log_scale_(symmetric(kInf, c.max_scale_rate_hz, c.max_scale_rate_hz, kScaleSlack),
                 c.recover_images, c.reestablish_s),
      log_height_({std::log(c.min_height_m), std::log(c.max_height_m), c.max_scale_rate_hz,
                   c.max_scale_rate_hz, kHeightSlack},
                  c.recover_images, c.reestablish_s),
      pitch_(
          symmetric(c.max_pitch_rad, c.max_tilt_rate_rad_s, c.max_tilt_rate_rad_s, kTiltSlackRad),
          c.recover_images, c.reestablish_s),
      roll_(symmetric(c.max_roll_rad, c.max_tilt_rate_rad_s, c.max_tilt_rate_rad_s, kTiltSlackRad),
            c.recover_images, c.reestablish_s) {}

void Plausibility::reset() { *this = Plausibility(config_); }

bool Plausibility::interval_plausible(double interval_s) const {
  return interval_s >= config_.min_interval_s && interval_s <= config_.max_interval_s;
}

PlausibilityVerdict Plausibility::update(const VehicleMotion& motion) {
  PlausibilityVerdict verdict;
  judge_plane(motion, &verdict);
  judge_speed(motion, &verdict);
  judge_yaw_rate(motion, &verdict);
  judge_acceleration(motion, &verdict);
  judge_pose(motion, &verdict);
  return verdict;
}

void Plausibility::judge_speed(const VehicleMotion& motion, PlausibilityVerdict* verdict) {
  PlausibilityReason& reason = (*verdict)[VehicleSignal::kSpeed];
  const bool has_interval = interval_plausible(motion.interval_s);
  const bool agrees =
      has_interval && !contradict(motion.step_m, std::abs(motion.speed_m_s) * motion.interval_s,
                                  kStepSlackM + 3.0 * motion.speed_std_m_s * motion.interval_s);
  if (motion.is_reset) log_scale_.reset();
  const double elapsed_s = has_interval ? motion.interval_s : 0.0;
  const PlausibilityReason scale = log_scale_.update(motion.log_scale, elapsed_s);
  const bool scale_jumps = scale == PlausibilityReason::kTooFast;
  const bool is_usable = has_interval && agrees && !scale_jumps;
  reason = speed_.update(is_usable ? motion.speed_m_s : kNan, elapsed_s);
  if (speed_.was_reestablished()) verdict->must_reset = true;
  if (std::isnan(motion.speed_m_s)) return;
  if (!has_interval) {
    reason = PlausibilityReason::kInterval;
  } else if (!agrees) {
    reason = PlausibilityReason::kInconsistent;
  } else if (scale_jumps) {
    reason = PlausibilityReason::kTooFast;
  }
}

void Plausibility::judge_yaw_rate(const VehicleMotion& motion, PlausibilityVerdict* verdict) {
  PlausibilityReason& reason = (*verdict)[VehicleSignal::kYawRate];
  const bool has_interval = interval_plausible(motion.interval_s);
  const bool agrees =
      has_interval &&
      !contradict(motion.turn_rad, motion.yaw_rate_rad_s * motion.interval_s, kTurnSlackRad);
  const double lateral_m_s2 = std::abs(motion.speed_m_s * motion.yaw_rate_rad_s);
  const bool slides =
      verdict->is_valid(VehicleSignal::kSpeed) && lateral_m_s2 > config_.max_lateral_accel_m_s2;
  const double elapsed_s = has_interval ? motion.interval_s : 0.0;
  reason = yaw_rate_.update(agrees && !slides ? motion.yaw_rate_rad_s : kNan, elapsed_s);
  if (std::isnan(motion.yaw_rate_rad_s)) return;
  if (!has_interval) {
    reason = PlausibilityReason::kInterval;
  } else if (!agrees) {
    reason = PlausibilityReason::kInconsistent;
  } else if (slides) {
    reason = PlausibilityReason::kOutOfRange;
  }
}

void Plausibility::judge_acceleration(const VehicleMotion& motion,
                                      PlausibilityVerdict* verdict) const {
  PlausibilityReason& reason = (*verdict)[VehicleSignal::kAcceleration];
  if (std::isnan(motion.accel_m_s2)) {
    reason = PlausibilityReason::kNotMeasured;
  } else if (!verdict->is_valid(VehicleSignal::kSpeed)) {
    reason = PlausibilityReason::kDependent;
  } else if (std::abs(motion.accel_m_s2) > config_.max_accel_m_s2) {
    reason = PlausibilityReason::kOutOfRange;
  }
}

void Plausibility::judge_pose(const VehicleMotion& motion, PlausibilityVerdict* verdict) {
  PlausibilityReason& reason = (*verdict)[VehicleSignal::kPose];
  const double covered_m = motion.distance_m - last_distance_m_;
  last_distance_m_ = motion.distance_m;
  if (std::isnan(motion.distance_m)) {
    reason = PlausibilityReason::kNotMeasured;
  } else if (!motion.is_reset && contradict(covered_m, motion.step_m, kStepSlackM)) {
    reason = PlausibilityReason::kInconsistent;
  } else if (!verdict->is_valid(VehicleSignal::kSpeed)) {
    reason = PlausibilityReason::kDependent;
  }
}

void Plausibility::judge_plane(const VehicleMotion& motion, PlausibilityVerdict* verdict) {
  const double elapsed_s = interval_plausible(motion.interval_s) ? motion.interval_s : 0.0;
  const double log_height = motion.height_m > 0.0    ? std::log(motion.height_m)
                            : motion.height_m <= 0.0 ? -kInf
                                                     : kNan;
  (*verdict)[VehicleSignal::kHeight] = log_height_.update(log_height, elapsed_s);
  (*verdict)[VehicleSignal::kPitch] = pitch_.update(motion.pitch_rad, elapsed_s);
  (*verdict)[VehicleSignal::kRoll] = roll_.update(motion.roll_rad, elapsed_s);
}

}  // namespace plumb
