#include "modules/can/can_gate.hpp"

#include <cmath>
#include <utility>

#include "core/channels.hpp"
#include "modules/can/can_e2e.hpp"
#include "modules/can/can_time.hpp"

namespace plumb {
namespace {

double number(CanValidity validity) { return static_cast<double>(validity); }
double count(std::int64_t value) { return static_cast<double>(value); }

// A status that claims to hold is believed only if the values that matter most are numbers.
CanValidity validity_of(const CanEgo& ego) {
  if (!std::isfinite(ego.speed_m_s) || !std::isfinite(ego.yaw_rate_rad_s)) {
    return CanValidity::kInvalid;
  }
  switch (ego.status) {
    case CanEgoStatus::kOk:
    case CanEgoStatus::kStandstill:
      return CanValidity::kValid;
    case CanEgoStatus::kScaleHeld:
    case CanEgoStatus::kCoasting:
      return CanValidity::kDegraded;
    case CanEgoStatus::kInitializing:
    case CanEgoStatus::kLost:
      break;
  }
  return CanValidity::kInvalid;
}

CanValidity validity_of(const CanPlane& plane) {
  if (!std::isfinite(plane.pitch_rad) || !std::isfinite(plane.roll_rad) ||
      !std::isfinite(plane.height_m)) {
    return CanValidity::kInvalid;
  }
  if (plane.status == CanPlaneStatus::kOk) return CanValidity::kValid;
  if (plane.status == CanPlaneStatus::kHeld) return CanValidity::kDegraded;
  return CanValidity::kInvalid;
}

void put(const CanEgo& ego, CanValues* v) {
  const CanValidity validity = validity_of(ego);
  v->ego_validity = number(validity);
  v->ego_status = static_cast<double>(ego.status);
  v->ego_reason = ego.reason;
  v->reset_counter = static_cast<std::uint32_t>(ego.reset_counter) % 255U;
  if (validity == CanValidity::kInvalid) return;
  v->standstill = ego.status == CanEgoStatus::kStandstill ? 1.0 : 0.0;
  v->speed_m_s = ego.speed_m_s;
  v->speed_std_m_s = ego.speed_std_m_s;
  v->lateral_speed_m_s = ego.lateral_speed_m_s;
  v->yaw_rate_rad_s = ego.yaw_rate_rad_s;
  v->yaw_rate_std_rad_s = ego.yaw_rate_std_rad_s;
  v->accel_m_s2 = ego.accel_m_s2;
  v->accel_std_m_s2 = ego.accel_std_m_s2;
  v->x_m = ego.x_m;
  v->y_m = ego.y_m;
  v->z_m = ego.z_m;
  v->heading_rad = ego.heading_rad;
  v->distance_m = ego.distance_m;
  v->scale_std_ratio = ego.scale_std_ratio;
}

void put(const CanPlane& plane, CanValues* v) {
  const CanValidity validity = validity_of(plane);
  v->plane_validity = number(validity);
  v->plane_status = static_cast<double>(plane.status);
  v->plane_reason = plane.reason;
  v->cues_used = plane.cues_used;
  if (validity == CanValidity::kInvalid) return;
  v->pitch_rad = plane.pitch_rad;
  v->roll_rad = plane.roll_rad;
  v->height_m = plane.height_m;
  v->pitch_std_rad = plane.pitch_std_rad;
  v->roll_std_rad = plane.roll_std_rad;
  v->height_std_m = plane.height_std_m;
}

void put(const CanMount& mount, CanValues* v) {
  v->mount_status = static_cast<double>(mount.status);
  v->mount_reason = mount.reason;
  v->mount_progress = mount.progress;
  v->mount_pitch_rad = mount.pitch_rad;
  v->mount_roll_rad = mount.roll_rad;
  v->mount_yaw_rad = mount.yaw_rad;
}

CanMode mode_of(const CanValues& v, bool fresh) {
  if (!fresh) return CanMode::kNoInput;
  const double valid = number(CanValidity::kValid);
  const double degraded = number(CanValidity::kDegraded);
  if (v.ego_validity == valid && v.plane_validity == valid) return CanMode::kNormal;
  const bool ego_holds = v.ego_validity == valid || v.ego_validity == degraded;
  const bool plane_holds = v.plane_validity == valid || v.plane_validity == degraded;
  if (ego_holds && plane_holds) return CanMode::kDegraded;
  const bool ego_starts = v.ego_status == static_cast<double>(CanEgoStatus::kInitializing);
  const bool plane_starts = v.plane_status == static_cast<double>(CanPlaneStatus::kInitializing);
  return ego_starts || plane_starts ? CanMode::kInitializing : CanMode::kFailed;
}

}  // namespace

CanGate::CanGate(const CanConfig& config)
    : stale_us_(std::llround(config.stale_s * 1e6)),
      pair_wait_us_(std::llround(config.pair_wait_s * 1e6)) {
  // Everything is due at the first tick.
  for (std::size_t i = 0; i < kNumMessages; ++i) ms_since_sent_[i] = messages()[i].cycle_ms;
}

void CanGate::on_ground_plane(const CanPlane& plane, std::int64_t now_us) {
  Entry* entry = entry_of(plane.seq, now_us);
  if (entry == nullptr || entry->has_plane) {
    ++counters_.num_repeated;
    return;
  }
  entry->plane = plane;
  entry->has_plane = true;
  settle(*entry);
}

void CanGate::on_ego_motion(const CanEgo& ego, std::int64_t now_us) {
  Entry* entry = entry_of(ego.seq, now_us);
  if (entry == nullptr || entry->has_ego) {
    ++counters_.num_repeated;
    return;
  }
  entry->ego = ego;
  entry->has_ego = true;
  settle(*entry);
}

void CanGate::on_mount(const CanMount& mount, std::int64_t now_us) {
  (void)pending_mounts_.push({now_us, mount});
}

/// After a half was put into `entry`.
void CanGate::settle(const Entry& entry) {
  if (&entry == &open_ && entry.has_plane && entry.has_ego) close();
  if (&entry == &current_) is_changed_ = true;
}

/// Where a half of frame `seq` belongs; null when that frame is gone.
CanGate::Entry* CanGate::entry_of(std::int64_t seq, std::int64_t now_us) {
  if (is_open_ && open_.seq == seq) return &open_;
  if (order_.take(seq) == SeqStep::kRepeat) return newest_closed(seq);
  if (is_open_) close();
  counters_.num_missed = order_.num_lost();
  open_ = Entry{};
  open_.seq = seq;
  open_.received_us = now_us;
  is_open_ = true;
  return &open_;
}

/// The frame taken last, when that was `seq` and it is still here: a late half joins it.
CanGate::Entry* CanGate::newest_closed(std::int64_t seq) {
  if (!pending_.empty()) return pending_.back().seq == seq ? &pending_.back() : nullptr;
  return has_current_ && current_.seq == seq ? &current_ : nullptr;
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

CanValues CanGate::compose(std::int64_t now_us) const {
  CanValues v;  // all not available
  v.frame_counter = has_current_ ? static_cast<double>(current_.seq & 0xFF) : 0.0;
  const bool fresh = has_current_ && age_us(now_us, current_.received_us) <= stale_us_;
  if (fresh && current_.has_ego) put(current_.ego, &v);
  if (fresh && current_.has_plane) put(current_.plane, &v);
  if (has_mount_ && age_us(now_us, mount_.received_us) <= kMount.stale_us) put(mount_.mount, &v);

  v.mode = static_cast<double>(mode_of(v, fresh));
  v.num_missed = count(counters_.num_missed);
  v.num_overflowed = count(counters_.num_overflowed);
  v.num_rejected = count(counters_.num_rejected);
  v.num_unsent = count(counters_.num_unsent);
  v.database_version = kDatabaseVersion;
  v.version_major = PLUMB_VERSION_MAJOR;
  v.version_minor = PLUMB_VERSION_MINOR;
  v.version_patch = PLUMB_VERSION_PATCH;
  v.uptime_s = std::floor(count(age_us(now_us, start_us_)) * 1e-6);
  return v;
}

void CanGate::tick(std::int64_t now_us, CanSink& sink) {
  if (!is_started_) start_us_ = now_us;
  is_started_ = true;
  const bool is_new = next(now_us);
  const bool is_mount_new = next_mount();
  const CanValues values = compose(now_us);
  for (std::size_t i = 0; i < kNumMessages; ++i) {
    const Message& message = messages()[i];
    ms_since_sent_[i] += kTickMs;
    const bool is_triggered = (is_new && message.trigger == CanTrigger::kCameraFrame) ||
                              (is_mount_new && message.trigger == CanTrigger::kMountMessage);
    if (ms_since_sent_[i] < message.cycle_ms && !is_triggered) continue;
    sink.send(now_us, encode(message, values, alive_[i]));
    alive_[i] = static_cast<std::uint8_t>((alive_[i] + 1U) % kE2eCounterModulo);
    ms_since_sent_[i] = 0;
  }
}

void CanGate::report(std::int64_t num_rejected, std::int64_t num_unsent) {
  counters_.num_rejected = num_rejected;
  counters_.num_unsent = num_unsent;
}

}  // namespace plumb
