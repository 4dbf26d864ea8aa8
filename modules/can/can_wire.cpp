#include "modules/can/can_wire.hpp"

#include <cmath>

namespace plumb {
namespace {

constexpr const char* kOtherSource =
    "another sender publishes on this channel: two plumb-ground, or a log that is played";

std::int64_t microseconds(double s) { return std::llround(s * 1e6); }

}  // namespace

CanOutput::CanOutput(const CanConfig& config, const PlausibilityConfig& vehicle)
    : messages_(can_messages(config)),
      source_(microseconds(config.stale_s)),
      motion_judge_(vehicle),
      plane_judge_(vehicle),
      gate_(config, messages_),
      object_gate_(config, messages_) {}

void CanOutput::set_session(std::int64_t session_us) {
  // Runs that follow each other within 25 s have different values for certain, others by chance.
  constexpr std::int64_t kUnitUs = 100'000;
  constexpr std::uint64_t kValues = 255;
  const auto start = static_cast<std::uint64_t>(session_us / kUnitUs);
  gate_.set_start(static_cast<std::uint32_t>(start % kValues));
  motion_judge_.set_first_reset(static_cast<std::uint32_t>(start / kValues % kValues));
}

const char* CanOutput::on_ground_plane(const ground_plane_t& message, std::int64_t now_us) {
  if (const char* const fault = fault_of(message)) return counted(fault);
  if (!source_.take(message.session, now_us)) return counted(kOtherSource);
  to_sample(plane_judge_.judge(message), messages_, &sample_);
  gate_.on_ground_plane(sample_, now_us);
  return nullptr;
}

const char* CanOutput::on_ego_motion(const ego_motion_t& message, std::int64_t now_us) {
  if (const char* const fault = fault_of(message)) return counted(fault);
  if (!source_.take(message.session, now_us)) return counted(kOtherSource);
  to_sample(motion_judge_.judge(message), messages_, &sample_);
  gate_.on_ego_motion(sample_, now_us);
  return nullptr;
}

const char* CanOutput::on_mount(const mount_t& message, std::int64_t now_us) {
  if (const char* const fault = fault_of(message)) return counted(fault);
  to_sample(message, messages_, &sample_);
  gate_.on_mount(sample_, now_us);
  return nullptr;
}

const char* CanOutput::on_objects(const objects_t& message, std::int64_t now_us) {
  if (const char* const fault = fault_of(message)) return counted(fault);
  to_sample(message, messages_, &objects_);
  object_gate_.on_objects(objects_, now_us);
  return nullptr;
}

const char* CanOutput::counted(const char* fault) {
  ++num_rejected_;
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
