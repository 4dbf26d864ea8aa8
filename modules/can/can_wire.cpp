#include "modules/can/can_wire.hpp"

#include <cmath>

#include "modules/can/validity_wire.hpp"
#include "plumb/detection_t.hpp"

namespace plumb {
namespace {

// Reasons of the motion travel in 6 bits, those of the plane in 5; all ones means "not available".
constexpr int kMaxMotionReason = 62;
constexpr int kMaxReason = 30;

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
      is_std(m.log_scale_std) ||
      (m.status == ego_motion_t::STATUS_STANDSTILL && std::isnan(m.log_scale_std));
  return is_std(m.speed_std_m_s) && is_std(m.yaw_rate_std_rad_s) && is_std(m.distance_m) &&
         scale_holds;
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
void read_signals(const Source& source, bool is_valid, const Messages& messages,
                  SourceValues* values) {
  values->fill(kNotAvailable);
  for (const Message& message : messages) {
    for (std::size_t i = 0; i < message.signals.size(); ++i) {
      const SignalValue& value = message.signals[i].value;
      const auto* const get = std::get_if<Getter<Source>>(&value.get);
      if (get == nullptr || (value.only_when_valid && !is_valid)) continue;
      (*values)[message.slot[i]] = (*get)(source);
    }
  }
}

template <typename Source>
void fill_sample(const Source& source, const Messages& messages, CanSample* sample) {
  sample->validity = validity_of(source);
  read_signals(source, sample->validity != CanValidity::kInvalid, messages, &sample->values);
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
  return std::hypot(o.position_ground_m[0], o.position_ground_m[1]);
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

const char* from_wire(const ego_motion_t& message, const Messages& messages, CanSample* ego) {
  if (message.seq < 0) return "negative sequence number";
  if (message.status < ego_motion_t::STATUS_OK || message.status > ego_motion_t::STATUS_LOST) {
    return "unknown status";
  }
  if (message.reason < 0 || message.reason > kMaxMotionReason) return "unknown reason";
  if (validity_of(message) != CanValidity::kInvalid && !motion_is_sound(message)) {
    return "motion is not a number although its status is valid";
  }
  ego->seq = message.seq;
  ego->is_initializing = message.status == ego_motion_t::STATUS_INITIALIZING;
  fill_sample(message, messages, ego);
  return nullptr;
}

const char* from_wire(const ground_plane_t& message, const Messages& messages, CanSample* plane) {
  if (message.seq < 0) return "negative sequence number";
  if (message.status < ground_plane_t::STATUS_OK ||
      message.status > ground_plane_t::STATUS_INVALID) {
    return "unknown status";
  }
  if (message.reason < 0 || message.reason > kMaxReason) return "unknown reason";
  if (message.num_cues < 0 || message.cues.size() != static_cast<std::size_t>(message.num_cues)) {
    return "wrong number of cues";
  }
  if (validity_of(message) != CanValidity::kInvalid && !plane_is_sound(message)) {
    return "plane is not a number although its status is valid";
  }
  plane->seq = message.seq;
  plane->is_initializing = message.status == ground_plane_t::STATUS_INITIALIZING;
  fill_sample(message, messages, plane);
  return nullptr;
}

const char* from_wire(const mount_t& message, const Messages& messages, CanSample* mount) {
  if (message.status < mount_t::STATUS_COLLECTING || message.status > mount_t::STATUS_MOVED) {
    return "unknown status";
  }
  if (message.reason < 0 || message.reason > kMaxReason) return "unknown reason";
  if (!(message.progress >= 0.0 && message.progress <= 1.0)) return "progress outside [0, 1]";
  if (validity_of(message) != CanValidity::kInvalid && !mount_is_sound(message)) {
    return "angles are not numbers although there is a reference";
  }
  fill_sample(message, messages, mount);
  return nullptr;
}

const char* from_wire(const objects_t& message, const Messages& messages, CanObjects* objects) {
  if (message.seq < 0) return "negative sequence number";
  if (message.num_objects < 0 || message.num_objects > objects_t::MAX_OBJECTS ||
      message.objects.size() != static_cast<std::size_t>(message.num_objects) ||
      message.num_refused < 0) {
    return "wrong number of objects";
  }
  NearestObjects nearest;
  for (const object_t& object : message.objects) {
    if (const char* const fault = fault_of(object)) return fault;
    if (object.status != object_t::STATUS_NOT_LOCALISED) nearest.insert(object);
  }
  const std::size_t num_objects = nearest.all().size();
  objects->seq = message.seq;
  objects->counts.num_objects = num_objects;
  objects->counts.num_left_out =
      message.num_refused + message.num_objects - static_cast<std::int64_t>(num_objects);
  for (std::size_t i = 0; i < num_objects; ++i) {
    read_signals(*nearest.all()[i], true, messages, &objects->objects[i]);
  }
  return nullptr;
}

CanOutput::CanOutput(const CanConfig& config)
    : messages_(can_messages(config)), gate_(config, messages_), object_gate_(config, messages_) {}

const char* CanOutput::on_ground_plane(const ground_plane_t& message, std::int64_t now_us) {
  const char* const fault = from_wire(message, messages_, &sample_);
  if (fault == nullptr) gate_.on_ground_plane(sample_, now_us);
  return counted(fault);
}

const char* CanOutput::on_ego_motion(const ego_motion_t& message, std::int64_t now_us) {
  const char* const fault = from_wire(message, messages_, &sample_);
  if (fault == nullptr) gate_.on_ego_motion(sample_, now_us);
  return counted(fault);
}

const char* CanOutput::on_mount(const mount_t& message, std::int64_t now_us) {
  const char* const fault = from_wire(message, messages_, &sample_);
  if (fault == nullptr) gate_.on_mount(sample_, now_us);
  return counted(fault);
}

const char* CanOutput::on_objects(const objects_t& message, std::int64_t now_us) {
  const char* const fault = from_wire(message, messages_, &objects_);
  if (fault == nullptr) object_gate_.on_objects(objects_, now_us);
  return counted(fault);
}

const char* CanOutput::counted(const char* fault) {
  if (fault != nullptr) ++num_rejected_;
  return fault;
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
