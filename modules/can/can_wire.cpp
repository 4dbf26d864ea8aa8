#include "modules/can/can_wire.hpp"

#include <cmath>

#include "plumb/vo_motion_t.hpp"

namespace plumb {
namespace {

constexpr bool same(CanEgoStatus ours, std::int8_t theirs) {
  return static_cast<std::int8_t>(ours) == theirs;
}
constexpr bool same(CanPlaneStatus ours, std::int8_t theirs) {
  return static_cast<std::int8_t>(ours) == theirs;
}
static_assert(same(CanEgoStatus::kOk, ego_motion_t::STATUS_OK));
static_assert(same(CanEgoStatus::kInitializing, ego_motion_t::STATUS_INITIALIZING));
static_assert(same(CanEgoStatus::kScaleHeld, ego_motion_t::STATUS_SCALE_HELD));
static_assert(same(CanEgoStatus::kStandstill, ego_motion_t::STATUS_STANDSTILL));
static_assert(same(CanEgoStatus::kCoasting, ego_motion_t::STATUS_COASTING));
static_assert(same(CanEgoStatus::kLost, ego_motion_t::STATUS_LOST));
static_assert(same(CanPlaneStatus::kOk, ground_plane_t::STATUS_OK));
static_assert(same(CanPlaneStatus::kInitializing, ground_plane_t::STATUS_INITIALIZING));
static_assert(same(CanPlaneStatus::kHeld, ground_plane_t::STATUS_HELD));
static_assert(same(CanPlaneStatus::kInvalid, ground_plane_t::STATUS_INVALID));

// Reasons travel in 4 bits, all ones is taken.
constexpr int kMaxReason = 14;
static_assert(vo_motion_t::REASON_RESTARTED <= kMaxReason);
static_assert(ground_plane_t::REASON_NO_CALIBRATION <= kMaxReason);

bool is_deviation(double value) { return std::isfinite(value) && value >= 0.0; }

bool motion_is_sound(const ego_motion_t& m) {
  double q2 = 0.0;
  for (const double q : m.q_world_cam) q2 += q * q;
  if (!(std::abs(q2 - 1.0) < 1e-6)) return false;
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(m.velocity_ground_m_s[i]) || !std::isfinite(m.rate_ground_rad_s[i]) ||
        !std::isfinite(m.t_world_cam_m[i])) {
      return false;
    }
  }
  return is_deviation(m.speed_std_m_s) && is_deviation(m.yaw_rate_std_rad_s) &&
         is_deviation(m.distance_m) && is_deviation(m.log_scale_std);
}

/// Heading of the optical axis about the first image's up axis, left positive.
double heading_rad(const double (&q)[4]) {
  const double forward_x = 2.0 * (q[1] * q[3] + q[0] * q[2]);  // R(0,2), to the right
  const double forward_z = 1.0 - 2.0 * (q[1] * q[1] + q[2] * q[2]);
  return std::atan2(-forward_x, forward_z);
}

}  // namespace

bool from_wire(const ego_motion_t& message, CanEgo* ego) {
  if (message.seq < 0 || message.status < ego_motion_t::STATUS_OK ||
      message.status > ego_motion_t::STATUS_LOST || message.reason < 0 ||
      message.reason > kMaxReason) {
    return false;
  }
  *ego = CanEgo{};
  ego->seq = message.seq;
  ego->status = static_cast<CanEgoStatus>(message.status);
  ego->reason = static_cast<int>(message.reason);
  ego->reset_counter = message.reset_counter;
  if (ego->status == CanEgoStatus::kInitializing || ego->status == CanEgoStatus::kLost) return true;
  if (!motion_is_sound(message)) return false;

  ego->speed_m_s = message.velocity_ground_m_s[0];
  ego->lateral_speed_m_s = message.velocity_ground_m_s[1];
  ego->speed_std_m_s = message.speed_std_m_s;
  ego->yaw_rate_rad_s = message.rate_ground_rad_s[2];
  ego->yaw_rate_std_rad_s = message.yaw_rate_std_rad_s;
  if (std::isfinite(message.accel_forward_m_s2) && is_deviation(message.accel_forward_std_m_s2)) {
    ego->accel_m_s2 = message.accel_forward_m_s2;
    ego->accel_std_m_s2 = message.accel_forward_std_m_s2;
  }
  // The world is the first image's camera (x right, y down, z forward); CAN speaks ISO 8855.
  ego->x_m = message.t_world_cam_m[2];
  ego->y_m = -message.t_world_cam_m[0];
  ego->z_m = -message.t_world_cam_m[1];
  ego->heading_rad = heading_rad(message.q_world_cam);
  ego->distance_m = message.distance_m;
  ego->scale_std_ratio = message.log_scale_std;
  return true;
}

bool from_wire(const ground_plane_t& message, CanPlane* plane) {
  constexpr int kNumCues = 3;
  if (message.seq < 0 || message.status < ground_plane_t::STATUS_OK ||
      message.status > ground_plane_t::STATUS_INVALID || message.reason < 0 ||
      message.reason > kMaxReason || message.num_cues < 0 || message.num_cues > kNumCues) {
    return false;
  }
  *plane = CanPlane{};
  plane->seq = message.seq;
  plane->status = static_cast<CanPlaneStatus>(message.status);
  plane->reason = static_cast<int>(message.reason);
  for (int i = 0; i < message.num_cues; ++i) {
    if (message.cues[i].status == 0) plane->cues_used += 1 << i;
  }
  if (plane->status != CanPlaneStatus::kOk && plane->status != CanPlaneStatus::kHeld) return true;
  if (!std::isfinite(message.pitch_rad) || !std::isfinite(message.roll_rad) ||
      !std::isfinite(message.height_m) || message.height_m <= 0.0) {
    return false;
  }
  for (int i = 0; i < 3; ++i) {
    if (!is_deviation(message.cov[i][i])) return false;
  }
  plane->pitch_rad = message.pitch_rad;
  plane->roll_rad = message.roll_rad;
  plane->height_m = message.height_m;
  plane->pitch_std_rad = std::sqrt(message.cov[0][0]);
  plane->roll_std_rad = std::sqrt(message.cov[1][1]);
  plane->height_std_m = message.height_m * std::sqrt(message.cov[2][2]);
  return true;
}

bool CanOutput::on_ground_plane(const ground_plane_t& message, std::int64_t now_us) {
  if (!from_wire(message, &plane_)) {
    ++num_rejected_;
    return false;
  }
  gate_.on_ground_plane(plane_, now_us);
  return true;
}

bool CanOutput::on_ego_motion(const ego_motion_t& message, std::int64_t now_us) {
  if (!from_wire(message, &ego_)) {
    ++num_rejected_;
    return false;
  }
  gate_.on_ego_motion(ego_, now_us);
  return true;
}

void CanOutput::tick(std::int64_t now_us, CanSink& sink) {
  gate_.report(num_rejected_ + num_undecoded_, num_unsent_);
  gate_.tick(now_us, sink);
}

void CanOutput::advance(std::int64_t now_us, CanSink& sink) {
  // Limits keep the sums below from overflowing on a hostile clock.
  constexpr std::int64_t kLimitUs = INT64_MAX / 4;
  if (now_us < -kLimitUs || now_us > kLimitUs) return;
  const bool jumped = is_started_ && (now_us < next_tick_us_ - CanGate::kTickUs ||
                                      now_us > next_tick_us_ + kMaxStepUs);
  if (jumped) finish(sink);
  if (jumped || !is_started_) next_tick_us_ = now_us;
  is_started_ = true;
  for (; next_tick_us_ <= now_us; next_tick_us_ += CanGate::kTickUs) tick(next_tick_us_, sink);
}

void CanOutput::finish(CanSink& sink) {
  while (is_started_ && !gate_.idle()) {
    tick(next_tick_us_, sink);
    next_tick_us_ += CanGate::kTickUs;
  }
}

}  // namespace plumb
