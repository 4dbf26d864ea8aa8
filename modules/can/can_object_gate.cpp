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

bool CanObjectGate::is_fresh(const CanObjects& list, std::int64_t now_us) const {
  return judge_age(now_us, list.capture_mono_us, stale_us_) == AgeState::kFresh;
}

void CanObjectGate::on_objects(const CanObjects& objects, std::int64_t now_us) {
  if (judge_age(now_us, objects.capture_mono_us, stale_us_) == AgeState::kTooOld) ++num_late_;
  if (!pending_.push(objects)) ++num_overflowed_;
}

void CanObjectGate::tick(std::int64_t now_us, CanSink& sink) {
  ms_since_list_ += CanGate::kTickMs;
  const bool is_new = !pending_.empty();
  if (is_new) {
    current_ = pending_.front();
    has_current_ = true;
    pending_.drop_front();
    while (!pending_.empty() && !is_fresh(current_, now_us)) {
      if (current_.capture_mono_us != 0) ++num_overflowed_;  // else its age is not known yet
      current_ = pending_.front();
      pending_.drop_front();
    }
  }
  const bool is_due = has_current_ && ms_since_list_ >= messages_[kObjectList].address.cycle_ms;
  if (is_new || is_due) send_list(now_us, sink);
  if (!is_new || !is_fresh(current_, now_us)) return;
  for (std::size_t i = 0; i < current_.counts.num_objects; ++i) send_object(i, now_us, sink);
}

void CanObjectGate::send_list(std::int64_t now_us, CanSink& sink) {
  MessageValues values;
  values.fill(kNotAvailable);
  const Message& message = messages_[kObjectList];
  current_.counts.age_s = age_signal_s(now_us, current_.capture_mono_us);
  for (std::size_t i = 0; i < message.signals.size(); ++i) {
    const SignalValue& value = message.signals[i].value;
    const auto* const get = std::get_if<Getter<CanObjectCounts>>(&value.get);
    if (get == nullptr) continue;
    // The age says why the rest is not available.
    if (value.group == Group::kAlways || is_fresh(current_, now_us))
      values[i] = (*get)(current_.counts);
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
        values[i] = current_.objects[index][message.slot[i]];
      }
    }
    send(m, values, index, now_us, sink);
  }
}

void CanObjectGate::send(std::size_t message, const MessageValues& values, std::size_t index,
                         std::int64_t now_us, CanSink& sink) {
  const FrameFields fields{alive_[message], static_cast<std::uint8_t>(current_.seq & 0xFF),
                           static_cast<std::uint8_t>(index)};
  sink.send(now_us, encode(messages_[message], values, fields));
  alive_[message] = static_cast<std::uint8_t>((alive_[message] + 1U) % kE2eCounterModulo);
}

}  // namespace plumb
