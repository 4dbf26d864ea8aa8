#include "tools/monitor/event_watch.hpp"

#include "core/channels.hpp"
#include "modules/datasets/text.hpp"
#include "tools/run/replay/names.hpp"

namespace plumb {
namespace {

constexpr const char* kHealthStates[] = {"running", "waiting for input", "degraded", "stopping"};

constexpr int kDegradedState = 2;

/// A reason that differs from another in its figures alone is no news.
std::string without_digits(std::string text) {
  std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
  return text;
}

EventLevel level_of(bool is_lost, bool is_fine) {
  if (is_lost) return EventLevel::kAlarm;
  return is_fine ? EventLevel::kInfo : EventLevel::kWarning;
}

}  // namespace

int chain_process(const std::string& name) {
  for (std::size_t i = 0; i < kChainProcesses.size(); ++i)
    if (name == kChainProcesses[i]) return static_cast<int>(i);
  return -1;
}

void EventWatch::follow(const char* source, int status, int reason, EventLevel level,
                        NameOf status_name, NameOf reason_name, Status* last) {
  const bool is_first = last->status < 0;
  const bool changed = status != last->status;
  const bool new_reason = reason != last->reason && reason != 0;
  if (changed || new_reason) {
    std::string text = changed && !is_first
                           ? format("%s -> %s", status_name(last->status), status_name(status))
                           : std::string(status_name(status));
    if (reason != 0) text += format(": %s", reason_name(reason));
    sink_(level, source, text);
  }
  *last = {status, reason};
}

void EventWatch::follow_session(const char* source, std::int64_t session, std::int64_t* last) {
  if (*last >= 0 && session != *last)
    sink_(EventLevel::kAlarm, source, "the process was restarted");
  *last = session;
}

void EventWatch::take(const vo_motion_t& message) {
  follow_session("vo", message.session, &vo_session_);
  if (scale_epoch_ >= 0 && message.scale_epoch != scale_epoch_)
    sink_(EventLevel::kWarning, "vo",
          format("reset: new unit of length, scale epoch %d", message.scale_epoch));
  scale_epoch_ = message.scale_epoch;
  const bool lost = message.status == vo_motion_t::STATUS_LOST;
  const bool fine = message.status != vo_motion_t::STATUS_COASTING &&
                    message.status != vo_motion_t::STATUS_INITIALIZING;
  follow("vo", message.status, message.reason, level_of(lost, fine), vo_status_name, vo_reason_name,
         &vo_);
}

void EventWatch::take(const ground_plane_t& message) {
  const bool lost = message.status == ground_plane_t::STATUS_INVALID;
  const bool fine = message.status == ground_plane_t::STATUS_OK;
  follow("plane", message.status, message.reason, level_of(lost, fine), plane_status_name,
         plane_reason_name, &plane_);
}

void EventWatch::take(const ego_motion_t& message) {
  follow_session("ground", message.session, &ground_session_);
  if (reset_counter_ >= 0 && message.reset_counter != reset_counter_)
    sink_(EventLevel::kAlarm, "ego",
          format("reset: the path is not continuous, reset counter %d", message.reset_counter));
  reset_counter_ = message.reset_counter;
  const bool lost = message.status == ego_motion_t::STATUS_LOST;
  const bool fine = message.status == ego_motion_t::STATUS_OK ||
                    message.status == ego_motion_t::STATUS_STANDSTILL;
  follow("ego", message.status, message.reason, level_of(lost, fine), ego_status_name,
         vo_reason_name, &ego_);
}

void EventWatch::take(const mount_t& message) {
  const bool alarm = message.status == mount_t::STATUS_MOVED ||
                     message.status == mount_t::STATUS_MISALIGNED ||
                     message.reason == mount_t::REASON_UPSIDE_DOWN;
  // The reason says why one image was not used, and that is news only with the picture upside down.
  const int reason = message.reason == mount_t::REASON_UPSIDE_DOWN ? message.reason : 0;
  follow("mount", message.status, reason,
         level_of(alarm, message.status != mount_t::STATUS_UNSTEADY), mount_status_name,
         mount_reason_name, &mount_);
}

void EventWatch::tell_losses(const process_health_t& message, const char* process, Health* last) {
  const std::int64_t num_bad = message.num_rejected + message.num_dropped + message.num_late +
                               message.num_skipped + message.num_unsent;
  // A state that says so is an event of its own.
  if (last->state >= 0 && num_bad > last->num_bad && message.state != kDegradedState)
    sink_(EventLevel::kWarning, process,
          format("rejected, dropped, late, skipped or unsent: %lld more",
                 static_cast<long long>(num_bad - last->num_bad)));
  last->num_bad = num_bad;
}

void EventWatch::take(const process_health_t& message, std::int64_t now_us) {
  const int place = chain_process(message.process);
  if (place < 0) return;
  const auto i = static_cast<std::size_t>(place);
  Health& last = health_[i];
  if (last.silent) sink_(EventLevel::kInfo, kChainProcesses[i], "reports again");
  tell_losses(message, kChainProcesses[i], &last);
  const std::string reason = without_digits(message.state_reason);
  if (message.state != last.state || reason != last.reason) {
    const bool known = message.state >= 0 && message.state < 4;
    std::string text = known ? kHealthStates[message.state] : "state ?";
    if (!message.state_reason.empty()) text += ": " + message.state_reason;
    const bool is_worse = message.state == kDegradedState;
    sink_(is_worse ? EventLevel::kWarning : EventLevel::kInfo, kChainProcesses[i], text);
  }
  last.time_us = now_us;
  last.silent = false;
  last.state = message.state;
  last.reason = reason;
}

void EventWatch::check_silence(std::int64_t now_us) {
  for (std::size_t i = 0; i < health_.size(); ++i) {
    Health& last = health_[i];
    if (last.time_us == 0 || last.silent || now_us - last.time_us <= kHealthVo.stale_us) continue;
    last.silent = true;
    sink_(EventLevel::kAlarm, kChainProcesses[i], "the process is silent");
  }
}

void EventWatch::take_can_faults(std::int64_t num_faults, std::int64_t now_us) {
  constexpr std::int64_t kPauseUs = 1'000'000;
  if (num_faults <= num_can_faults_ || now_us - kPauseUs < can_told_us_) return;
  sink_(EventLevel::kWarning, "CAN",
        format("%lld frames more with a wrong checksum, missing or repeated",
               static_cast<long long>(num_faults - num_can_faults_)));
  num_can_faults_ = num_faults;
  can_told_us_ = now_us;
}

}  // namespace plumb
