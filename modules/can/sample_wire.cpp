#include "modules/can/sample_wire.hpp"

#include <cmath>
#include <initializer_list>

#include "core/numbers.hpp"
#include "modules/can/validity_wire.hpp"
#include "plumb/detection_t.hpp"

namespace plumb {
namespace {

// Reasons of the motion travel in 6 bits, the others in 4; all ones means "not available".
constexpr int kMaxMotionReason = 62;
constexpr int kMaxReason = 14;

/// Whether a number was measured, or is not stated.
bool is_finite_or_nan(double value) { return !std::isinf(value); }
bool is_std_or_nan(double value) { return std::isnan(value) || is_std(value); }

bool motion_is_sound(const ego_motion_t& m) {
  double q2 = 0.0;
  for (const double q : m.q_world_cam) {
    if (!is_finite_or_nan(q)) return false;
    q2 += q * q;
  }
  if (!std::isnan(q2) && !(std::abs(q2 - 1.0) < 1e-6)) return false;
  for (int i = 0; i < 3; ++i) {
    if (!is_finite_or_nan(m.velocity_ground_m_s[i]) || !is_finite_or_nan(m.rate_ground_rad_s[i]) ||
        !is_finite_or_nan(m.t_world_cam_m[i])) {
      return false;
    }
  }
  return is_std_or_nan(m.speed_std_m_s) && is_std_or_nan(m.yaw_rate_std_rad_s) &&
         is_std_or_nan(m.distance_m) && is_std_or_nan(m.log_scale_std);
}

bool plane_is_sound(const ground_plane_t& m) {
  for (int i = 0; i < 3; ++i) {
    if (!is_std(m.cov[i][i])) return false;
  }
  return std::isfinite(m.pitch_rad) && std::isfinite(m.roll_rad) && std::isfinite(m.height_m) &&
         m.height_m > 0.0;
}

bool mount_is_sound(const mount_t& m) {
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(m.reference_rad[i]) || std::isinf(m.recent_rad[i])) return false;
    // A reference of an earlier run is steady before this one's first stretch.
    if (std::isnan(m.recent_rad[i]) && m.status == mount_t::STATUS_MOVED) return false;
  }
  return true;
}

bool place_is_sound(const object_t& o) {
  return std::isfinite(o.position_ground_m[0]) && std::isfinite(o.position_ground_m[1]) &&
         is_std(o.position_cov_m2[0][0]) && is_std(o.position_cov_m2[1][1]) &&
         is_std(o.size_m[1]) && is_std(o.age_s);
}

/// Gives every signal that comes from this message its value.
template <typename Source>
void read_signals(const Source& source, const Messages& messages, SourceValues* values) {
  values->fill(kNotAvailable);
  for (const Message& message : messages) {
    for (std::size_t i = 0; i < message.signals.size(); ++i) {
      const auto* const get = std::get_if<Getter<Source>>(&message.signals[i].value.get);
      if (get != nullptr) (*values)[message.slot[i]] = (*get)(source);
    }
  }
}

template <typename Source>
void fill_sample(CanSource kind, const Source& source, GroupValidities validities,
                 std::initializer_list<Group> groups, const Messages& messages, CanSample* sample) {
  read_signals(source, messages, &sample->values);
  settle_values(kind, messages, &validities, &sample->values);
  sample->validity = CanValidity::kValid;
  sample->has_values = false;
  for (const Group group : groups) {
    const CanValidity validity = validities[static_cast<std::size_t>(group)];
    lower_validity(validity, &sample->validity);
    if (validity != CanValidity::kInvalid) sample->has_values = true;
  }
}

/// Null when the object keeps its contract, else what breaks it.
const char* fault_of(const object_t& o) {
  if (o.status < object_t::STATUS_MEASURED || o.status > object_t::STATUS_NOT_LOCALISED) {
    return "unknown status of an object";
  }
  if (o.class_id < detection_t::CLASS_UNKNOWN || o.class_id > detection_t::CLASS_CYCLIST) {
    return "unknown class of an object";
  }
  if (o.status != object_t::STATUS_NOT_LOCALISED && !place_is_sound(o)) {
    return "an object's place is not a number";
  }
  return nullptr;
}

double range_m(const object_t& o) {
  return root_sum_square(o.position_ground_m[0], o.position_ground_m[1]);
}

/// The nearest objects with a place on the road, in order; of equally near ones the first.
class NearestObjects {
 public:
  void insert(const object_t& object) {
    std::size_t place = size_;
    while (place > 0 && range_m(*objects_[place - 1]) > range_m(object)) --place;
    if (place == kMaxCanObjects) return;
    if (size_ < kMaxCanObjects) ++size_;
    for (std::size_t i = size_ - 1; i > place; --i) objects_[i] = objects_[i - 1];
    objects_[place] = &object;
  }
  [[nodiscard]] std::span<const object_t* const> all() const { return {objects_.data(), size_}; }

 private:
  std::array<const object_t*, kMaxCanObjects> objects_{};
  std::size_t size_ = 0;
};

}  // namespace

const char* fault_of(const ego_motion_t& message) {
  if (message.seq < 0) return "negative sequence number";
  if (message.status < ego_motion_t::STATUS_OK || message.status > ego_motion_t::STATUS_LOST) {
    return "unknown status";
  }
  if (message.reason < 0 || message.reason > kMaxMotionReason) return "unknown reason";
  if (validity_of(message) != CanValidity::kInvalid && !motion_is_sound(message)) {
    return "motion is not a number although its status is valid";
  }
  return nullptr;
}

const char* fault_of(const ground_plane_t& message) {
  if (message.seq < 0) return "negative sequence number";
  if (message.status < ground_plane_t::STATUS_OK ||
      message.status > ground_plane_t::STATUS_INVALID) {
    return "unknown status";
  }
  if (message.reason < 0 || message.reason > kMaxReason) return "unknown reason";
  if (message.num_cues < 0 || message.num_cues > ground_plane_t::MAX_CUES ||
      message.cues.size() != static_cast<std::size_t>(message.num_cues)) {
    return "wrong number of cues";
  }
  if (validity_of(message) != CanValidity::kInvalid && !plane_is_sound(message)) {
    return "plane is not a number although its status is valid";
  }
  return nullptr;
}

const char* fault_of(const mount_t& message) {
  if (message.status < mount_t::STATUS_COLLECTING || message.status > mount_t::STATUS_MISALIGNED) {
    return "unknown status";
  }
  if (message.reason < 0 || message.reason > kMaxReason) return "unknown reason";
  if (!(message.progress >= 0.0 && message.progress <= 1.0)) return "progress outside [0, 1]";
  if (validity_of(message) != CanValidity::kInvalid && !mount_is_sound(message)) {
    return "angles are not numbers although there is a reference";
  }
  return nullptr;
}

const char* fault_of(const objects_t& message) {
  if (message.seq < 0) return "negative sequence number";
  if (message.num_objects < 0 || message.num_objects > objects_t::MAX_OBJECTS ||
      message.objects.size() != static_cast<std::size_t>(message.num_objects) ||
      message.num_refused < 0) {
    return "wrong number of objects";
  }
  for (const object_t& object : message.objects) {
    if (const char* const fault = fault_of(object)) return fault;
  }
  return nullptr;
}

void to_sample(const JudgedMotion& motion, const Messages& messages, CanSample* sample) {
  sample->seq = motion.seq;
  sample->session = motion.session;
  sample->capture_mono_us = motion.capture_mono_us;
  sample->is_initializing = motion.status == ego_motion_t::STATUS_INITIALIZING;
  fill_sample(CanSource::kEgo, motion, motion.validity, {Group::kMain, Group::kPose}, messages,
              sample);
}

void to_sample(const JudgedPlane& plane, const Messages& messages, CanSample* sample) {
  sample->seq = plane.seq;
  sample->session = plane.session;
  sample->capture_mono_us = plane.capture_mono_us;
  sample->is_initializing = plane.status == ground_plane_t::STATUS_INITIALIZING;
  fill_sample(CanSource::kPlane, plane, plane.validity, {Group::kMain}, messages, sample);
}

void to_sample(const mount_t& mount, const Messages& messages, CanSample* sample) {
  fill_sample(CanSource::kMountCheck, mount, same_validity(validity_of(mount)), {Group::kMain},
              messages, sample);
}

void to_sample(const objects_t& message, const Messages& messages, CanObjects* objects) {
  NearestObjects nearest;
  for (const object_t& object : message.objects) {
    if (object.status != object_t::STATUS_NOT_LOCALISED) nearest.insert(object);
  }
  const std::size_t num_objects = nearest.all().size();
  objects->seq = message.seq;
  objects->capture_mono_us = message.capture_mono_us;
  objects->counts.num_objects = num_objects;
  objects->counts.num_left_out =
      message.num_refused + message.num_objects - static_cast<std::int64_t>(num_objects);
  for (std::size_t i = 0; i < num_objects; ++i) {
    GroupValidities validities = same_validity(CanValidity::kValid);
    read_signals(*nearest.all()[i], messages, &objects->objects[i]);
    settle_values(CanSource::kObject, messages, &validities, &objects->objects[i]);
  }
}

}  // namespace plumb
