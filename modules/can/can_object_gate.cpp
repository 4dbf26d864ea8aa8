#include "modules/can/can_object_gate.hpp"

#include <cmath>

#include "modules/can/can_codec.hpp"
#include "modules/can/can_e2e.hpp"
#include "modules/can/can_gate.hpp"
#include "modules/can/can_time.hpp"

namespace plumb {
namespace {

constexpr std::size_t kObjectList = message_index("ObjectList");

}  // namespace

CanObjectGate::CanObjectGate(const CanConfig& config, const Messages& messages)
    : messages_(messages), stale_us_(std::llround(config.stale_s * 1e6)) {}

void CanObjectGate::on_objects(const CanObjects& objects, std::int64_t now_us) {
  if (!pending_.push({now_us, objects})) ++num_overflowed_;
}

void CanObjectGate::tick(std::int64_t now_us, CanSink& sink) {
  ms_since_list_ += CanGate::kTickMs;
  if (!pending_.empty()) {
    current_ = pending_.front();
    has_current_ = true;
    pending_.drop_front();
    send_list(true, now_us, sink);
    for (std::size_t i = 0; i < current_.list.counts.num_objects; ++i) {
      send_object(i, now_us, sink);
    }
  } else if (has_current_ && ms_since_list_ >= messages_[kObjectList].address.cycle_ms) {
    send_list(age_us(now_us, current_.received_us) <= stale_us_, now_us, sink);
  }
}

void CanObjectGate::send_list(bool fresh, std::int64_t now_us, CanSink& sink) {
  MessageValues values;
  values.fill(kNotAvailable);
  const Message& message = messages_[kObjectList];
  for (std::size_t i = 0; fresh && i < message.signals.size(); ++i) {
    const auto* const get = std::get_if<Getter<CanObjectCounts>>(&message.signals[i].value.get);
    if (get != nullptr) values[i] = (*get)(current_.list.counts);
  }
  send(kObjectList, values, 0, now_us, sink);
  ms_since_list_ = 0;
}

void CanObjectGate::send_object(std::size_t index, std::int64_t now_us, CanSink& sink) {
  for (std::size_t m = 0; m < kNumMessages; ++m) {
    const Message& message = messages_[m];
    if (message.row->trigger != CanTrigger::kObject) continue;
    MessageValues values;
    values.fill(kNotAvailable);
    for (std::size_t i = 0; i < message.signals.size(); ++i) {
      if (source_of(message.signals[i]) == CanSource::kObject) {
        values[i] = current_.list.objects[index][message.slot[i]];
      }
    }
    send(m, values, index, now_us, sink);
  }
}

void CanObjectGate::send(std::size_t message, const MessageValues& values, std::size_t index,
                         std::int64_t now_us, CanSink& sink) {
  const FrameFields fields{alive_[message], static_cast<std::uint8_t>(current_.list.seq & 0xFF),
                           static_cast<std::uint8_t>(index)};
  sink.send(now_us, encode(messages_[message], values, fields));
  alive_[message] = static_cast<std::uint8_t>((alive_[message] + 1U) % kE2eCounterModulo);
}

}  // namespace plumb
