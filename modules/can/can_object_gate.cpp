#include "modules/can/can_object_gate.hpp"

#include <cmath>

#include "modules/can/can_e2e.hpp"
#include "modules/can/can_gate.hpp"
#include "modules/can/can_time.hpp"

namespace plumb {
namespace {

constexpr std::size_t kList = 0;

CanValues values_of(const CanObjects& list, bool fresh) {
  CanValues v;
  v.object_frame_counter = static_cast<double>(list.seq & 0xFF);
  if (!fresh) return v;
  v.num_objects = static_cast<double>(list.num_objects);
  v.num_objects_left_out = static_cast<double>(list.num_left_out);
  return v;
}

void put(const CanObject& object, std::size_t index, CanValues* v) {
  v->object_index = static_cast<double>(index);
  v->object_id = static_cast<std::uint32_t>(object.id) % 255U;
  v->object_class = object.object_class;
  v->object_status = static_cast<double>(object.status);
  v->object_x_m = object.x_m;
  v->object_y_m = object.y_m;
  v->object_x_std_m = object.x_std_m;
  v->object_y_std_m = object.y_std_m;
  v->object_vx_m_s = object.vx_m_s;
  v->object_vy_m_s = object.vy_m_s;
  v->object_vx_std_m_s = object.vx_std_m_s;
  v->object_vy_std_m_s = object.vy_std_m_s;
  v->object_width_m = object.width_m;
  v->object_ttc_s = object.time_to_collision_s;
  v->object_age_s = object.age_s;
}

}  // namespace

CanObjectGate::CanObjectGate(const CanConfig& config)
    : stale_us_(std::llround(config.stale_s * 1e6)) {}

void CanObjectGate::on_objects(const CanObjects& objects, std::int64_t now_us) {
  if (!pending_.push({now_us, objects})) ++num_overflowed_;
}

void CanObjectGate::tick(std::int64_t now_us, CanSink& sink) {
  ms_since_list_ += CanGate::kTickMs;
  if (!pending_.empty()) {
    current_ = pending_.front();
    has_current_ = true;
    pending_.drop_front();
    CanValues values = values_of(current_.list, true);
    send(kList, values, now_us, sink);
    for (std::size_t i = 0; i < current_.list.num_objects; ++i) {
      put(current_.list.objects[i], i, &values);
      for (std::size_t m = kList + 1; m < kNumObjectMessages; ++m) send(m, values, now_us, sink);
    }
  } else if (has_current_ && ms_since_list_ >= object_messages()[kList].cycle_ms) {
    const bool fresh = age_us(now_us, current_.received_us) <= stale_us_;
    send(kList, values_of(current_.list, fresh), now_us, sink);
  }
}

void CanObjectGate::send(std::size_t message, const CanValues& values, std::int64_t now_us,
                         CanSink& sink) {
  sink.send(now_us, encode(object_messages()[message], values, alive_[message]));
  alive_[message] = static_cast<std::uint8_t>((alive_[message] + 1U) % kE2eCounterModulo);
  if (message == kList) ms_since_list_ = 0;
}

}  // namespace plumb
