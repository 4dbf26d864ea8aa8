#include "modules/objects/objects_wire.hpp"

#include <cmath>

#include "core/numbers.hpp"
#include "core/pose_wire.hpp"
#include "core/same_value.hpp"

namespace plumb {
namespace {

static_assert(same(ObjectStatus::kMeasured, object_t::STATUS_MEASURED));
static_assert(same(ObjectStatus::kPredicted, object_t::STATUS_PREDICTED));
static_assert(same(ObjectStatus::kNotLocalised, object_t::STATUS_NOT_LOCALISED));
static_assert(same(ObjectReason::kNone, object_t::REASON_NONE));
static_assert(same(ObjectReason::kCut, object_t::REASON_CUT));
static_assert(same(ObjectReason::kHidden, object_t::REASON_HIDDEN));
static_assert(same(ObjectReason::kCalibratedPlane, object_t::REASON_CALIBRATED_PLANE));
static_assert(same(ObjectReason::kNotSeen, object_t::REASON_NOT_SEEN));
static_assert(same(ObjectReason::kMisfit, object_t::REASON_MISFIT));
static_assert(same(ObjectReason::kNoFit, object_t::REASON_NO_FIT));
static_assert(kMaxObjects == objects_t::MAX_OBJECTS);

void write_object(const ObjectOutput& object, object_t* out) {
  out->track_id = object.track_id;
  out->class_id = static_cast<std::int8_t>(object.object_class);
  out->status = static_cast<std::int8_t>(object.status);
  out->reason = static_cast<std::int8_t>(object.reason);
  out->position_ground_m[0] = object.position_m.x();
  out->position_ground_m[1] = object.position_m.y();
  out->position_ground_m[2] = 0.0;
  to_wire(object.position_cov_m2, out->position_cov_m2);
  for (int i = 0; i < 2; ++i) {
    out->velocity_ground_m_s[i] = object.velocity_valid ? object.velocity_m_s(i) : kNan;
    for (int j = 0; j < 2; ++j) {
      out->velocity_cov_m2_s2[i][j] =
          object.velocity_valid ? object.velocity_cov_m2_s2(i, j) : kNan;
    }
  }
  out->yaw_rad = object.yaw_rad;
  out->yaw_std_rad = object.yaw_std_rad;
  to_wire(object.size_m, out->size_m);
  to_wire(object.size_std_m, out->size_std_m);
  out->time_to_collision_s = object.time_to_collision_s;
  out->age_s = object.age_s;
}

const char* velocity_from_wire(const object_t& message, ObjectOutput* object) {
  object->velocity_valid = !std::isnan(message.velocity_ground_m_s[0]);
  if (!object->velocity_valid) return nullptr;
  object->velocity_m_s = Eigen::Vector2d(message.velocity_ground_m_s);
  if (!object->velocity_m_s.allFinite()) return "a velocity is not finite";
  return from_wire(message.velocity_cov_m2_s2, &object->velocity_cov_m2_s2);
}

const char* object_from_wire(const object_t& message, ObjectOutput* object) {
  if (message.class_id < 0 || message.class_id >= static_cast<std::int8_t>(kNumObjectClasses)) {
    return "objects: unknown class";
  }
  if (message.status < object_t::STATUS_MEASURED ||
      message.status > object_t::STATUS_NOT_LOCALISED) {
    return "objects: unknown status";
  }
  if (message.reason < object_t::REASON_NONE || message.reason > object_t::REASON_NO_FIT) {
    return "objects: unknown reason";
  }
  object->track_id = message.track_id;
  object->object_class = static_cast<ObjectClass>(message.class_id);
  object->status = static_cast<ObjectStatus>(message.status);
  object->reason = static_cast<ObjectReason>(message.reason);
  object->age_s = message.age_s;
  object->time_to_collision_s = message.time_to_collision_s;
  if (!(object->age_s >= 0.0) || object->time_to_collision_s < 0.0) {
    return "objects: age or time to collision is below zero";
  }
  object->position_m = {message.position_ground_m[0], message.position_ground_m[1]};
  object->yaw_rad = message.yaw_rad;
  object->yaw_std_rad = message.yaw_std_rad;
  object->size_m = Eigen::Vector3d(message.size_m);
  object->size_std_m = Eigen::Vector3d(message.size_std_m);
  const bool sound = object->position_m.allFinite() && std::isfinite(object->yaw_rad) &&
                     object->yaw_std_rad >= 0.0 && object->size_m.allFinite() &&
                     object->size_m.minCoeff() >= 0.0 && object->size_std_m.minCoeff() >= 0.0 &&
                     from_wire(message.position_cov_m2, &object->position_cov_m2) == nullptr &&
                     velocity_from_wire(message, object) == nullptr;
  return sound ? nullptr : "objects: a position, size or standard deviation is not a number";
}

}  // namespace

void to_wire(const ObjectsOutput& output, objects_t* message) {
  message->utime = output.capture_us;
  message->seq = output.seq;
  message->num_refused = output.num_refused;
  message->num_objects = static_cast<std::int32_t>(output.objects.size());
  message->objects.resize(output.objects.size());
  for (std::size_t i = 0; i < output.objects.size(); ++i) {
    write_object(output.objects[i], &message->objects[i]);
  }
}

const char* from_wire(const objects_t& message, ObjectsOutput* output) {
  if (message.num_objects < 0 || message.num_objects > objects_t::MAX_OBJECTS ||
      message.objects.size() != static_cast<std::size_t>(message.num_objects)) {
    return "objects: number is outside [0, 32]";
  }
  if (message.num_refused < 0) return "objects: number refused is below zero";
  output->capture_us = message.utime;
  output->seq = message.seq;
  output->num_refused = message.num_refused;
  output->objects.clear();
  for (const object_t& one : message.objects) {
    ObjectOutput object;
    if (const char* why = object_from_wire(one, &object)) return why;
    if (!output->objects.push_back(object)) return "objects: number is outside [0, 32]";
  }
  return nullptr;
}

}  // namespace plumb
