#include "modules/can/judge_wire.hpp"

#include <cmath>

#include "core/numbers.hpp"
#include "modules/can/validity_wire.hpp"
#include "modules/integrity/stamp_difference.hpp"
#include "plumb/vo_motion_t.hpp"

namespace plumb {
namespace {

/// Whether a value that was there is not to be sent.
bool is_refused(PlausibilityReason reason) {
  return reason != PlausibilityReason::kNone && reason != PlausibilityReason::kNotMeasured;
}

/// Whether the motion itself cannot be that of a road vehicle.
bool is_implausible(PlausibilityReason reason) {
  return reason == PlausibilityReason::kOutOfRange || reason == PlausibilityReason::kTooFast ||
         reason == PlausibilityReason::kInconsistent;
}

double norm(const double (&v)[3]) { return root_sum_square(v[0], v[1], v[2]); }

bool is_rotation(const double (&q)[4]) {
  double q2 = 0.0;
  for (const double v : q) q2 += v * v;
  return std::abs(q2 - 1.0) < 1e-6;
}

/// The rotation about the vertical, left positive, out of that of the camera (y down).
double turn_rad(const double (&q)[4]) {
  const double sine = root_sum_square(q[1], q[2], q[3]);
  if (sine < 1e-12) return 0.0;
  const double angle_rad = 2.0 * std::atan2(sine, std::abs(q[0]));
  return -std::copysign(angle_rad, q[0]) * q[2] / sine;
}

double known(bool is_known, double value) { return is_known ? value : kNan; }

}  // namespace

void take_at_its_word(const ego_motion_t& message, JudgedMotion* judged) {
  static_cast<ego_motion_t&>(*judged) = message;
  judged->validity = same_validity(validity_of(message));
  judged->verdict = PlausibilityVerdict();
  judged->reset_count = static_cast<std::uint32_t>(message.reset_counter);
}

void take_at_its_word(const ground_plane_t& message, JudgedPlane* judged) {
  static_cast<ground_plane_t&>(*judged) = message;
  judged->validity = same_validity(validity_of(message));
  judged->verdict = PlausibilityVerdict();
}

double MessageInterval::step(std::int64_t session, std::int64_t seq, std::int64_t utime,
                             std::int64_t capture_mono_us, const PlausibilityConfig& config) {
  const auto interval_s = [&config](bool is_known, std::int64_t now_us, std::int64_t last_us) {
    const double s = static_cast<double>(stamp_difference(now_us, last_us)) * 1e-6;
    return known(is_known && s >= config.min_interval_s && s <= config.max_interval_s, s);
  };
  is_new_session_ = !has_last_ || session != session_;
  is_next_ = !is_new_session_ && seq_ < INT64_MAX && seq == seq_ + 1;
  double s = interval_s(!is_new_session_, utime, utime_);
  if (std::isnan(s)) {
    const bool both_known = has_last_ && capture_mono_us != 0 && capture_mono_us_ != 0;
    s = interval_s(both_known, capture_mono_us, capture_mono_us_);
  }
  has_last_ = true;
  session_ = session;
  seq_ = seq;
  utime_ = utime;
  capture_mono_us_ = capture_mono_us;
  return s;
}

const JudgedMotion& MotionJudge::judge(const ego_motion_t& message) {
  take_at_its_word(message, &judged_);
  const VehicleMotion motion = motion_of(message);
  if (interval_.is_new_session() && std::isnan(motion.interval_s)) check_.reset();
  judged_.verdict = check_.update(motion);
  count_resets(message);
  apply();
  return judged_;
}

VehicleMotion MotionJudge::motion_of(const ego_motion_t& m) {
  VehicleMotion motion;
  motion.interval_s = interval_.step(m.session, m.seq, m.utime, m.capture_mono_us, config_);
  const bool is_valid = validity_of(m) != CanValidity::kInvalid;
  motion.speed_m_s = known(is_valid, m.velocity_ground_m_s[0]);
  motion.speed_std_m_s = is_std(m.speed_std_m_s) ? m.speed_std_m_s : 0.0;
  motion.accel_m_s2 = known(is_valid, m.accel_forward_m_s2);
  motion.yaw_rate_rad_s = known(is_valid, m.rate_ground_rad_s[2]);
  // Without a unit quaternion the message states no motion between the images.
  const bool has_step = is_valid && interval_.is_next() && is_rotation(m.q_prev_cam);
  motion.step_m = known(has_step, norm(m.t_prev_cam_m));
  motion.turn_rad = known(has_step, turn_rad(m.q_prev_cam));
  motion.distance_m = known(is_valid, m.distance_m);
  motion.log_scale = known(is_valid, m.log_scale);
  motion.is_reset = interval_.is_new_session() || m.reset_counter != reset_counter_ ||
                    m.reason == vo_motion_t::REASON_RESTARTED ||
                    m.reason == vo_motion_t::REASON_ORIENTATION_UNPROVEN;
  return motion;
}

void MotionJudge::count_resets(const ego_motion_t& m) {
  // A counter that goes back belongs to a sender that began anew.
  const bool is_anew =
      has_pose_ && (interval_.is_new_session() || m.reset_counter < reset_counter_);
  const auto counted = static_cast<std::uint32_t>(m.reset_counter);
  const auto before = static_cast<std::uint32_t>(reset_counter_);
  reset_count_ += is_anew ? 1U : has_pose_ ? counted - before : counted;
  if (judged_.verdict.must_reset) ++reset_count_;
  has_pose_ = true;
  reset_counter_ = m.reset_counter;
  judged_.reset_count = reset_count_;
}

void MotionJudge::apply() {
  const PlausibilityVerdict& verdict = judged_.verdict;
  const PlausibilityReason speed = verdict[VehicleSignal::kSpeed];
  const PlausibilityReason yaw = verdict[VehicleSignal::kYawRate];
  const PlausibilityReason pose = verdict[VehicleSignal::kPose];
  if (is_refused(speed)) judged_.velocity_ground_m_s[0] = kNan;
  if (is_refused(yaw)) judged_.rate_ground_rad_s[2] = kNan;
  if (is_refused(verdict[VehicleSignal::kAcceleration])) judged_.accel_forward_m_s2 = kNan;
  if (pose == PlausibilityReason::kInconsistent) {
    for (double& m : judged_.t_world_cam_m) m = kNan;
    judged_.distance_m = kNan;
  } else if (is_refused(speed)) {
    // The pose is the sum of motions, of which the newest is not believed.
    lower_validity(CanValidity::kDegraded,
                   &judged_.validity[static_cast<std::size_t>(Group::kPose)]);
  }
  if (is_refused(speed) || is_refused(yaw) || pose == PlausibilityReason::kInconsistent) {
    ++num_refused_;
    last_reason_ = is_refused(speed) ? speed : is_refused(yaw) ? yaw : pose;
  }
  if (judged_.reason == vo_motion_t::REASON_NONE && (is_implausible(speed) || is_implausible(yaw)))
    judged_.reason = vo_motion_t::REASON_IMPLAUSIBLE;
}

PlaneJudge::PlaneJudge(const PlausibilityConfig& config) : config_(config), check_(config) {
  judged_.cues.reserve(ground_plane_t::MAX_CUES);
}

const JudgedPlane& PlaneJudge::judge(const ground_plane_t& m) {
  take_at_its_word(m, &judged_);
  VehicleMotion motion;
  motion.interval_s = interval_.step(m.session, m.seq, m.utime, m.capture_mono_us, config_);
  if (validity_of(m) != CanValidity::kInvalid) {
    motion.height_m = m.height_m;
    motion.pitch_rad = m.pitch_rad;
    motion.roll_rad = m.roll_rad;
  }
  if (interval_.is_new_session() && std::isnan(motion.interval_s)) check_.reset();
  judged_.verdict = check_.update(motion);
  bool any_refused = false;
  const auto drop = [&](VehicleSignal signal, double* value) {
    const PlausibilityReason reason = judged_.verdict[signal];
    if (!is_refused(reason)) return;
    *value = kNan;
    any_refused = true;
    last_reason_ = reason;
  };
  drop(VehicleSignal::kHeight, &judged_.height_m);
  drop(VehicleSignal::kPitch, &judged_.pitch_rad);
  drop(VehicleSignal::kRoll, &judged_.roll_rad);
  if (any_refused) ++num_refused_;
  return judged_;
}

}  // namespace plumb
