#include "modules/can/can_gate.hpp"

#include <cmath>
#include <utility>

#include "core/channels.hpp"
#include "modules/can/can_codec.hpp"
#include "modules/can/can_e2e.hpp"
#include "modules/can/can_time.hpp"

namespace plumb {
namespace {

bool is_valid(const CanSample* sample) {
  return sample != nullptr && sample->validity == CanValidity::kValid;
}
bool has_values(const CanSample* sample) { return sample != nullptr && sample->has_values; }
bool is_initializing(const CanSample* sample) {
  return sample != nullptr && sample->is_initializing;
}

CanMode mode_of(const CanSample* ego, const CanSample* plane) {
  if (is_valid(ego) && is_valid(plane)) return CanMode::kNormal;
  if (has_values(ego) && has_values(plane)) return CanMode::kDegraded;
  return is_initializing(ego) || is_initializing(plane) ? CanMode::kInitializing : CanMode::kFailed;
}

double value_in(const CanSample* sample, std::size_t slot) {
  return sample != nullptr ? sample->values[slot] : kNotAvailable;
}

}  // namespace

CanGate::CanGate(const CanConfig& config, const Messages& messages)
    : messages_(messages),
      stale_us_(std::llround(config.stale_s * 1e6)),
      pair_wait_us_(std::llround(config.pair_wait_s * 1e6)) {
  // Everything is due at the first tick.
  for (std::size_t i = 0; i < kNumMessages; ++i) {
    ms_since_sent_[i] = messages_[i].address.cycle_ms;
  }
}

void CanGate::on_ground_plane(const CanSample& plane, std::int64_t now_us) {
  Entry* entry = take(plane, now_us);
  if (entry == nullptr || entry->has_plane) {
    ++counters_.num_repeated;
    return;
  }
  entry->plane = plane;
  entry->has_plane = true;
  settle(*entry);
}

void CanGate::on_ego_motion(const CanSample& ego, std::int64_t now_us) {
  Entry* entry = take(ego, now_us);
  if (entry == nullptr || entry->has_ego) {
    ++counters_.num_repeated;
    return;
  }
  entry->ego = ego;
  entry->has_ego = true;
  settle(*entry);
}

CanGate::Entry* CanGate::take(const CanSample& half, std::int64_t now_us) {
  if (judge_age(now_us, half.capture_mono_us, stale_us_) == AgeState::kTooOld) ++counters_.num_late;
  return entry_of(half, now_us);
}

void CanGate::on_mount(const CanSample& mount, std::int64_t now_us) {
  (void)pending_mounts_.push({now_us, mount});
}

/// After a half was put into `entry`.
void CanGate::settle(const Entry& entry) {
  if (&entry == &open_ && entry.has_plane && entry.has_ego) close();
  if (&entry == &current_) is_changed_ = true;
}

/// Where a half of a frame belongs; null when that frame is gone.
CanGate::Entry* CanGate::entry_of(const CanSample& half, std::int64_t now_us) {
  if (half.session != session_) {
    if (is_open_) close();
    order_.restart();
    session_ = half.session;
  }
  if (is_open_ && open_.seq == half.seq) return &open_;
  if (order_.take(half.seq) == SeqStep::kRepeat) return newest_closed(half);
  if (is_open_) close();
  counters_.num_missed = order_.num_lost();
  open_ = Entry{};
  open_.seq = half.seq;
  open_.session = half.session;
  open_.received_us = now_us;
  is_open_ = true;
  return &open_;
}

/// The frame taken last, when it is the half's and still here: a late half joins it.
CanGate::Entry* CanGate::newest_closed(const CanSample& half) {
  const auto is_its = [&half](const Entry& entry) {
    return entry.seq == half.seq && entry.session == half.session;
  };
  if (!pending_.empty()) return is_its(pending_.back()) ? &pending_.back() : nullptr;
  return has_current_ && is_its(current_) ? &current_ : nullptr;
}

/// Queues the open entry, complete or not.
void CanGate::close() {
  if (!open_.has_plane || !open_.has_ego) ++counters_.num_unpaired;
  if (!pending_.push(open_)) ++counters_.num_overflowed;
  is_open_ = false;
}

/// Moves to the next camera frame. False when there is nothing new to send.
bool CanGate::next(std::int64_t now_us) {
  if (is_open_ && age_us(now_us, open_.received_us) > pair_wait_us_) close();
  if (is_changed_ || pending_.empty()) return std::exchange(is_changed_, false);
  current_ = pending_.front();
  has_current_ = true;
  pending_.drop_front();
  while (!pending_.empty() && !has_fresh_half(current_, now_us)) {
    // A frame of unknown age, as the first ones are, is no loss.
    const bool is_dated = current_.plane.capture_mono_us != 0 || current_.ego.capture_mono_us != 0;
    if (is_dated) ++counters_.num_passed;
    current_ = pending_.front();
    pending_.drop_front();
  }
  ++counters_.num_frames;
  return true;
}

bool CanGate::next_mount() {
  if (pending_mounts_.empty()) return false;
  mount_ = pending_mounts_.front();
  has_mount_ = true;
  pending_mounts_.drop_front();
  return true;
}

bool CanGate::is_fresh(const CanSample& half, std::int64_t now_us) const {
  return judge_age(now_us, half.capture_mono_us, stale_us_) == AgeState::kFresh;
}

bool CanGate::has_fresh_half(const Entry& entry, std::int64_t now_us) const {
  return (entry.has_ego && is_fresh(entry.ego, now_us)) ||
         (entry.has_plane && is_fresh(entry.plane, now_us));
}

/// Why nothing of the current frame is sent.
CanMode CanGate::mode_without_values(std::int64_t now_us) const {
  if (!has_current_ || age_us(now_us, current_.received_us) > stale_us_) return CanMode::kNoInput;
  const CanSample& half = current_.has_ego ? current_.ego : current_.plane;
  const AgeState age = judge_age(now_us, half.capture_mono_us, stale_us_);
  return age == AgeState::kTooOld ? CanMode::kTooOld : CanMode::kAgeUnknown;
}

CanState CanGate::state(const CanSample* ego, const CanSample* plane, std::int64_t now_us) const {
  CanState state;
  const bool has_any = ego != nullptr || plane != nullptr;
  state.mode = has_any ? mode_of(ego, plane) : mode_without_values(now_us);
  state.num_missed = counters_.num_missed;
  state.num_overflowed = counters_.num_overflowed;
  state.num_rejected = counters_.num_rejected;
  state.num_unsent = counters_.num_unsent;
  state.uptime_s = std::floor(static_cast<double>(age_us(now_us, start_us_)) * 1e-6);
  if (has_current_) {
    const CanSample& half = current_.has_ego ? current_.ego : current_.plane;
    state.age_s = age_signal_s(now_us, half.capture_mono_us);
  }
  state.start = start_;
  return state;
}

CanGate::Available CanGate::available(std::int64_t now_us) const {
  Available now;
  if (has_current_ && current_.has_ego && is_fresh(current_.ego, now_us)) now.ego = &current_.ego;
  if (has_current_ && current_.has_plane && is_fresh(current_.plane, now_us))
    now.plane = &current_.plane;
  if (has_mount_ && age_us(now_us, mount_.received_us) <= kMount.stale_us)
    now.mount = &mount_.mount;
  now.state = state(now.ego, now.plane, now_us);
  return now;
}

MessageValues CanGate::compose(const Message& message, const Available& now) {
  MessageValues values;
  values.fill(kNotAvailable);
  for (std::size_t i = 0; i < message.signals.size(); ++i) {
    const Signal& signal = message.signals[i];
    const std::size_t slot = message.slot[i];
    switch (source_of(signal)) {
      case CanSource::kState:
        values[i] = std::get<Getter<CanState>>(signal.value.get)(now.state);
        break;
      case CanSource::kEgo:
        values[i] = value_in(now.ego, slot);
        break;
      case CanSource::kPlane:
        values[i] = value_in(now.plane, slot);
        break;
      case CanSource::kMountCheck:
        values[i] = value_in(now.mount, slot);
        break;
      default:
        break;
    }
  }
  return values;
}

void CanGate::tick(std::int64_t now_us, CanSink& sink) {
  if (!is_started_) start_us_ = now_us;
  is_started_ = true;
  const bool is_new = next(now_us);
  const bool is_mount_new = next_mount();
  const Available now = available(now_us);
  const auto frame_counter = static_cast<std::uint8_t>(has_current_ ? current_.seq & 0xFF : 0);
  for (std::size_t i = 0; i < kNumMessages; ++i) {
    const Message& message = messages_[i];
    if (is_about_objects(message.row->trigger)) continue;
    ms_since_sent_[i] += kTickMs;
    const bool is_triggered = (is_new && message.row->trigger == CanTrigger::kCameraFrame) ||
                              (is_mount_new && message.row->trigger == CanTrigger::kMountMessage);
    if (ms_since_sent_[i] < message.address.cycle_ms && !is_triggered) continue;
    sink.send(now_us, encode(message, compose(message, now), {alive_[i], frame_counter, 0}));
    alive_[i] = static_cast<std::uint8_t>((alive_[i] + 1U) % kE2eCounterModulo);
    ms_since_sent_[i] = 0;
  }
}

void CanGate::report(std::int64_t num_rejected, std::int64_t num_unsent) {
  counters_.num_rejected = num_rejected;
  counters_.num_unsent = num_unsent;
}

}  // namespace plumb
