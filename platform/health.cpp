#include "platform/health.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "platform/memory_usage.hpp"
#include "platform/version.hpp"

namespace plumb {
namespace {

constexpr std::int64_t kTroubleShown_us = 1'000'000;

// Copies without allocating.
void assign(std::string* text, const char* value) {
  text->assign(value, std::min(std::char_traits<char>::length(value), Health::kMaxText));
}

}  // namespace

Health::Health(const char* process) {
  message_.state_reason.reserve(kMaxText);
  condition_reason_.reserve(kMaxText);
  trouble_.reserve(kMaxText);
  message_.stages.resize(StageTimer::kMaxStages);
  for (stage_latency_t& stage : message_.stages) stage.name.reserve(kMaxText);
  message_.process = process;
  message_.version = plumb_version();
}

void Health::set_condition(HealthState state, const char* reason, Output output) {
  condition_ = state;
  output_ = output;
  assign(&condition_reason_, reason);
}

const process_health_t& Health::report(std::int64_t now_us, const Counters& counters,
                                       const Bus& bus, const StageTimer& timer) {
  judge(now_us, counters, bus);
  const MemoryUsage memory = memory_usage();
  message_.utime = now_us;
  message_.num_received = counters.num_received;
  message_.num_rejected = counters.num_rejected;
  message_.num_dropped = counters.num_dropped;
  message_.num_late = counters.num_late;
  message_.num_skipped = counters.num_skipped;
  message_.num_unpaired = counters.num_unpaired;
  message_.num_published = counters.num_published;
  message_.num_unsent = counters.num_unsent;
  message_.receive_buffer_bytes = bus.receive_buffer_bytes();
  message_.memory_rss_bytes = memory.rss_bytes;
  message_.memory_peak_bytes = memory.peak_bytes;
  copy_stages(timer);
  return message_;
}

const process_health_t& Health::report_stopping(std::int64_t now_us, const char* reason) {
  message_.utime = now_us;
  set_state(HealthState::kStopping, reason);
  return message_;
}

void Health::set_state(HealthState state, const char* reason) {
  message_.state = static_cast<std::int8_t>(state);
  assign(&message_.state_reason, reason);
}

void Health::judge(std::int64_t now_us, const Counters& counters, const Bus& bus) {
  const bool trouble = judge_counters(now_us, counters);
  if (condition_ != HealthState::kRunning) return set_state(condition_, condition_reason_.c_str());
  for (const RawSubscriber* input : bus.subscribers()) {
    if (input->input() != Input::kPeriodic) continue;
    std::array<char, kMaxText> reason{};
    const std::int64_t silent_us = now_us - input->last_us();
    if (input->last_us() == 0) {
      std::snprintf(reason.data(), reason.size(), "no %s yet", input->channel().name);
    } else if (silent_us > std::max<std::int64_t>(input->channel().stale_us, 0)) {
      std::snprintf(reason.data(), reason.size(), "no %s for %.1f s", input->channel().name,
                    static_cast<double>(silent_us) * 1e-6);
    } else {
      continue;
    }
    return set_state(HealthState::kWaiting, reason.data());
  }
  if (trouble) return set_state(HealthState::kDegraded, trouble_.c_str());
  set_state(HealthState::kRunning, "");
}

bool Health::judge_counters(std::int64_t now_us, const Counters& now) {
  std::array<char, kMaxText> reason{};
  const auto say = [&](const char* format, std::int64_t count, const char* detail) {
    std::snprintf(reason.data(), reason.size(), format, static_cast<long long>(count), detail);
    assign(&trouble_, reason.data());
    trouble_until_us_ = now_us + kTroubleShown_us;
  };
  // Each later reason replaces the earlier ones, so the most serious comes last.
  if (now.num_late > before_.num_late)
    say("%lld messages processed late%s", now.num_late - before_.num_late, "");
  if (now.num_skipped > before_.num_skipped)
    say("%lld messages skipped for newer ones%s", now.num_skipped - before_.num_skipped, "");
  if (now.num_unpaired > before_.num_unpaired)
    say("%lld results without an input that came too late%s",
        now.num_unpaired - before_.num_unpaired, "");
  if (now.num_rejected > before_.num_rejected)
    say("%lld messages rejected: %s", now.num_rejected - before_.num_rejected, now.last_rejection);
  if (now.num_unsent > before_.num_unsent)
    say("%lld messages not sent%s", now.num_unsent - before_.num_unsent, "");
  if (now.num_dropped > before_.num_dropped)
    say("%lld messages lost%s", now.num_dropped - before_.num_dropped, "");
  before_ = now;
  return now_us < trouble_until_us_;
}

void Health::copy_stages(const StageTimer& timer) {
  const std::size_t count = std::min(timer.num_stages(), message_.stages.size());
  message_.num_stages = static_cast<std::int32_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const StageStats stats = timer.stats(i);
    stage_latency_t& out = message_.stages[i];
    assign(&out.name, stats.name);
    out.num_samples = stats.num_samples;
    out.median_us = stats.median_us;
    out.p99_us = stats.p99_us;
    out.max_us = stats.max_us;
  }
}

}  // namespace plumb
