#include "tools/monitor/can_view.hpp"

#include <cmath>

#include "modules/can/can_codec.hpp"
#include "modules/can/can_e2e.hpp"
#include "modules/can/signals/signal_tables.hpp"

namespace plumb {
namespace {

using nlohmann::json;

constexpr std::int64_t kBurstsStopUs = 1'000'000;

constexpr const char* kE2eNames[] = {"ok", "first", "lost", "repeated", "wrong"};

/// Index of the signal that carries `framing`, or -1.
int find_framing(const Message& message, Framing framing) {
  for (std::size_t i = 0; i < message.signals.size(); ++i) {
    if (is_framing(message.signals[i], framing)) return static_cast<int>(i);
  }
  return -1;
}

json signal_schema(const Signal& signal) {
  json names = json::array();
  for (const char* name : signal.names) names.push_back(name);
  const bool counts = is_framing(signal, Framing::kCrc) ||
                      is_framing(signal, Framing::kAliveCounter) ||
                      is_framing(signal, Framing::kFrameCounter);
  return {{"name", signal.name},
          {"unit", signal.unit},
          {"factor", signal.layout.factor},
          {"comment", signal.comment},
          {"names", std::move(names)},
          {"flags", signal.names_are_flags},
          {"validity", signal.value.need == Need::kIsValidity},
          {"framing", counts},
          {"start_bit", signal.layout.start_bit},
          {"length", signal.layout.length}};
}

}  // namespace

CanView::CanView(const CanConfig& config)
    : messages_(can_messages(config)),
      burst_counter_(
          static_cast<std::size_t>(find_framing(messages_[kBurstEnd], Framing::kFrameCounter))) {}

bool CanView::has_bursts(std::int64_t now_us) const {
  const Slot& slot = slots_[kBurstEnd];
  return slot.time_us != 0 && now_us - slot.time_us < kBurstsStopUs;
}

bool CanView::has_burst(std::int64_t seq) const {
  const Slot& slot = slots_[kBurstEnd];
  return slot.time_us != 0 && slot.values[burst_counter_] == static_cast<double>(seq & 0xff);
}

void CanView::follow_counter(int alive, Slot* slot) {
  if (slot->alive < 0) {
    slot->state = E2e::kFirst;
  } else {
    const int step = (alive - slot->alive + kE2eCounterModulo) % kE2eCounterModulo;
    slot->state = step == 1 ? E2e::kOk : step == 0 ? E2e::kRepeated : E2e::kLost;
    if (step == 0) ++slot->num_repeated;
    if (step > 1) slot->num_lost += step - 1;
    if (step != 1) ++num_faults_;
  }
  slot->alive = alive;
}

void CanView::take(const CanFrame& frame, std::int64_t now_us) {
  ++num_frames_;
  for (std::size_t i = 0; i < messages_.size(); ++i) {
    const Message& message = messages_[i];
    if (message.address.id != frame.id || message.address.extended != frame.extended) continue;
    Slot& slot = slots_[i];
    MessageValues values{};
    if (!decode(message, frame, &values)) {
      ++slot.num_wrong;
      ++num_faults_;
      slot.state = E2e::kWrong;
      return;
    }
    const int alive = find_framing(message, Framing::kAliveCounter);
    if (alive >= 0)
      follow_counter(static_cast<int>(values[static_cast<std::size_t>(alive)]), &slot);
    ++slot.num_frames;
    slot.time_us = now_us;
    slot.values = values;
    const int index = find_framing(message, Framing::kObjectIndex);
    if (index < 0) return;
    const double place = values[static_cast<std::size_t>(index)];
    if (place >= 0.0 && place < static_cast<double>(kMaxCanObjects))
      objects_[i][static_cast<std::size_t>(place)] = {now_us, values};
    return;
  }
  ++num_foreign_;
}

json CanView::schema() const {
  json all = json::array();
  for (const Message& message : messages_) {
    json signals = json::array();
    for (const Signal& signal : message.signals) signals.push_back(signal_schema(signal));
    all.push_back({{"name", message.row->name},
                   {"id", message.address.id},
                   {"extended", message.address.extended},
                   {"data_id", message.address.data_id},
                   {"cycle_ms", message.address.cycle_ms},
                   {"comment", message.row->comment},
                   {"signals", std::move(signals)}});
  }
  return all;
}

json CanView::values_of(std::size_t message, const MessageValues& values) const {
  json list = json::array();
  for (std::size_t i = 0; i < messages_[message].signals.size(); ++i) {
    const double value = values[i];
    list.push_back(std::isfinite(value) ? json(value) : json(nullptr));
  }
  return list;
}

json CanView::message_values(std::size_t message, std::int64_t now_us) const {
  const Slot& slot = slots_[message];
  json out = {{"message", message},
              {"age_ms", static_cast<double>(now_us - slot.time_us) * 1e-3},
              {"e2e", kE2eNames[static_cast<std::size_t>(slot.state)]},
              {"num_frames", slot.num_frames},
              {"num_wrong", slot.num_wrong},
              {"num_lost", slot.num_lost},
              {"num_repeated", slot.num_repeated}};
  if (find_framing(messages_[message], Framing::kObjectIndex) < 0) {
    out["values"] = values_of(message, slot.values);
    return out;
  }
  json objects = json::array();
  for (const ObjectSlot& object : objects_[message]) {
    if (object.time_us == 0 || now_us - object.time_us > kObjectAgeUs) continue;
    objects.push_back(values_of(message, object.values));
  }
  out["objects"] = std::move(objects);
  return out;
}

json CanView::values(std::int64_t now_us) const {
  json list = json::array();
  for (std::size_t i = 0; i < messages_.size(); ++i) {
    if (slots_[i].num_frames + slots_[i].num_wrong > 0) list.push_back(message_values(i, now_us));
  }
  return {
      {"messages", std::move(list)}, {"num_frames", num_frames_}, {"num_foreign", num_foreign_}};
}

}  // namespace plumb
