#include "modules/can/can_wire.hpp"

#include <algorithm>
#include <cmath>

#include "core/same_value.hpp"
#include "plumb/detection_t.hpp"
#include "plumb/vo_motion_t.hpp"

namespace plumb {
namespace {

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

static_assert(static_cast<int>(CanMountStatus::kCollecting) == mount_t::STATUS_COLLECTING);
static_assert(static_cast<int>(CanMountStatus::kUnsteady) == mount_t::STATUS_UNSTEADY);
static_assert(static_cast<int>(CanMountStatus::kSteady) == mount_t::STATUS_STEADY);
static_assert(static_cast<int>(CanMountStatus::kMoved) == mount_t::STATUS_MOVED);

static_assert(static_cast<int>(CanObjectStatus::kMeasured) == object_t::STATUS_MEASURED);
static_assert(static_cast<int>(CanObjectStatus::kPredicted) == object_t::STATUS_PREDICTED);
static_assert(static_cast<int>(CanObjectStatus::kNotLocalised) == object_t::STATUS_NOT_LOCALISED);

// Reasons travel in 4 bits, all ones is taken.
constexpr int kMaxReason = 14;
static_assert(vo_motion_t::REASON_RESTARTED <= kMaxReason);
static_assert(ground_plane_t::REASON_NO_CALIBRATION <= kMaxReason);
static_assert(mount_t::REASON_TURNING <= kMaxReason);

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
  // A car that has not moved yet stands still at no known scale.
  const bool scale_holds =
      is_deviation(m.log_scale_std) ||
      (m.status == ego_motion_t::STATUS_STANDSTILL && std::isnan(m.log_scale_std));
  return is_deviation(m.speed_std_m_s) && is_deviation(m.yaw_rate_std_rad_s) &&
         is_deviation(m.distance_m) && scale_holds;
}

/// Heading of the optical axis about the first image's up axis, left positive.
double heading_rad(const double (&q)[4]) {
  const double forward_x = 2.0 * (q[1] * q[3] + q[0] * q[2]);  // R(0,2), to the right
  const double forward_z = 1.0 - 2.0 * (q[1] * q[1] + q[2] * q[2]);
  return std::atan2(-forward_x, forward_z);
}

/// Standard deviation, or not available.
double deviation(double variance) {
  return is_deviation(variance) ? std::sqrt(variance) : kNotAvailable;
}

bool place_is_sound(const object_t& o) {
  return std::isfinite(o.position_ground_m[0]) && std::isfinite(o.position_ground_m[1]) &&
         is_deviation(o.position_cov_m2[0][0]) && is_deviation(o.position_cov_m2[1][1]) &&
         is_deviation(o.size_m[1]) && is_deviation(o.age_s);
}

bool from_wire(const object_t& message, CanObject* object) {
  if (message.status < object_t::STATUS_MEASURED ||
      message.status > object_t::STATUS_NOT_LOCALISED ||
      message.class_id < detection_t::CLASS_UNKNOWN ||
      message.class_id > detection_t::CLASS_CYCLIST) {
    return false;
  }
  object->id = message.track_id;
  object->object_class = static_cast<int>(message.class_id);
  object->status = static_cast<CanObjectStatus>(message.status);
  if (object->status == CanObjectStatus::kNotLocalised) return true;
  if (!place_is_sound(message)) return false;
  object->x_m = message.position_ground_m[0];
  object->y_m = message.position_ground_m[1];
  object->x_std_m = deviation(message.position_cov_m2[0][0]);
  object->y_std_m = deviation(message.position_cov_m2[1][1]);
  object->width_m = message.size_m[1];
  object->age_s = message.age_s;
  if (std::isfinite(message.time_to_collision_s))
    object->time_to_collision_s = message.time_to_collision_s;
  if (std::isfinite(message.velocity_ground_m_s[0]) &&
      std::isfinite(message.velocity_ground_m_s[1])) {
    object->vx_m_s = message.velocity_ground_m_s[0];
    object->vy_m_s = message.velocity_ground_m_s[1];
    object->vx_std_m_s = deviation(message.velocity_cov_m2_s2[0][0]);
    object->vy_std_m_s = deviation(message.velocity_cov_m2_s2[1][1]);
  }
  return true;
}

double range_m(const CanObject& object) { return std::hypot(object.x_m, object.y_m); }

/// Keeps the list sorted; what no longer fits counts as left out.
void insert_nearest(const CanObject& object, CanObjects* list) {
  std::size_t place = list->num_objects;
  while (place > 0 && range_m(list->objects[place - 1]) > range_m(object)) --place;
  if (list->num_objects == kMaxCanObjects) ++list->num_left_out;
  if (place == kMaxCanObjects) return;
  if (list->num_objects < kMaxCanObjects) ++list->num_objects;
  for (std::size_t i = list->num_objects - 1; i > place; --i)
    list->objects[i] = list->objects[i - 1];
  list->objects[place] = object;
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
  constexpr std::size_t kNumCueBits = 3;  // of the signal CuesUsed, whose 15 is "not available"
  if (message.seq < 0 || message.status < ground_plane_t::STATUS_OK ||
      message.status > ground_plane_t::STATUS_INVALID || message.reason < 0 ||
      message.reason > kMaxReason || message.num_cues < 0 ||
      message.cues.size() != static_cast<std::size_t>(message.num_cues)) {
    return false;
  }
  *plane = CanPlane{};
  plane->seq = message.seq;
  plane->status = static_cast<CanPlaneStatus>(message.status);
  plane->reason = static_cast<int>(message.reason);
  for (std::size_t i = 0; i < std::min(message.cues.size(), kNumCueBits); ++i) {
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

bool from_wire(const mount_t& message, CanMount* mount) {
  if (message.status < mount_t::STATUS_COLLECTING || message.status > mount_t::STATUS_MOVED ||
      message.reason < 0 || message.reason > kMaxReason ||
      !(message.progress >= 0.0 && message.progress <= 1.0)) {
    return false;
  }
  *mount = CanMount{};
  mount->status = static_cast<CanMountStatus>(message.status);
  mount->reason = static_cast<int>(message.reason);
  mount->progress = message.progress;
  const bool moved = mount->status == CanMountStatus::kMoved;
  if (!moved && mount->status != CanMountStatus::kSteady) return true;
  double* const angles[] = {&mount->pitch_rad, &mount->roll_rad, &mount->yaw_rad};
  for (int i = 0; i < 3; ++i) {
    const double recent_rad = message.recent_rad[i];
    if (!std::isfinite(message.reference_rad[i]) || std::isinf(recent_rad)) return false;
    // A reference of an earlier run is steady before this one's first stretch.
    if (std::isnan(recent_rad) && moved) return false;
    *angles[i] = recent_rad - message.reference_rad[i];
  }
  return true;
}

bool from_wire(const objects_t& message, CanObjects* objects) {
  if (message.seq < 0 || message.num_objects < 0 || message.num_refused < 0 ||
      message.num_objects > objects_t::MAX_OBJECTS ||
      message.objects.size() != static_cast<std::size_t>(message.num_objects)) {
    return false;
  }
  *objects = CanObjects{};
  objects->seq = message.seq;
  objects->num_left_out = message.num_refused;
  for (const object_t& object : message.objects) {
    CanObject one;
    if (!from_wire(object, &one)) return false;
    if (one.status == CanObjectStatus::kNotLocalised) {
      ++objects->num_left_out;
    } else {
      insert_nearest(one, objects);
    }
  }
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

bool CanOutput::on_mount(const mount_t& message, std::int64_t now_us) {
  if (!from_wire(message, &mount_)) {
    ++num_rejected_;
    return false;
  }
  gate_.on_mount(mount_, now_us);
  return true;
}

bool CanOutput::on_objects(const objects_t& message, std::int64_t now_us) {
  if (!from_wire(message, &objects_)) {
    ++num_rejected_;
    return false;
  }
  object_gate_.on_objects(objects_, now_us);
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
  object_gate_.tick(now_us, sink);
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
  while (is_started_ && !(gate_.idle() && object_gate_.idle())) {
    tick(next_tick_us_, sink);
    next_tick_us_ += CanGate::kTickUs;
  }
}

}  // namespace plumb
