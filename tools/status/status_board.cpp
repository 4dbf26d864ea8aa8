#include "tools/status/status_board.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plumb/status_names.hpp"

namespace plumb {
namespace {

constexpr std::array<const char*, 4> kStates = {"running", "waiting", "DEGRADED", "stopping"};
constexpr std::int8_t kRunningState = 0;

bool is_recent(std::int64_t heard_us, std::int64_t stale_us, std::int64_t now_us) {
  return heard_us != 0 && now_us - heard_us <= stale_us;
}

const char* state_name(const process_health_t& health) {
  const auto state = static_cast<std::size_t>(health.state);
  return state < kStates.size() ? kStates[state] : "?";
}

/// [ms] The 99th percentile of a whole image; NaN when the process times none.
double total_p99_ms(const process_health_t& health) {
  for (const stage_latency_t& stage : health.stages)
    if (stage.name == "total") return static_cast<double>(stage.p99_us) * 1e-3;
  return std::nan("");
}

double megabytes(std::int64_t bytes) { return static_cast<double>(bytes) * 1e-6; }

std::string or_dash(double value, const char* format) {
  if (!std::isfinite(value)) return "-";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

}  // namespace

void StatusBoard::take(const process_health_t& message, std::int64_t now_us) {
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (message.process == kProcesses[i]->publisher) rows_[i] = {message, now_us};
}

void StatusBoard::take(const ego_motion_t& message, std::int64_t now_us) {
  if (motion_.count == 0) motion_.first_us = now_us;
  motion_.newest = message;
  motion_.heard_us = now_us;
  ++motion_.count;
}

bool StatusBoard::is_needed(std::string_view process) const {
  return std::find(needed_.begin(), needed_.end(), process) != needed_.end();
}

bool StatusBoard::runs(std::size_t process, std::int64_t now_us) const {
  const Row& row = rows_[process];
  return is_recent(row.heard_us, kProcesses[process]->stale_us, now_us) &&
         row.health.state == kRunningState;
}

bool StatusBoard::is_well(std::int64_t now_us) const {
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (is_needed(kProcesses[i]->publisher) && !runs(i, now_us)) return false;
  return true;
}

std::string StatusBoard::row_text(std::size_t process, std::int64_t now_us) const {
  const Row& row = rows_[process];
  const Channel& channel = *kProcesses[process];
  std::array<char, 400> line{};
  if (!is_recent(row.heard_us, channel.stale_us, now_us)) {
    std::snprintf(line.data(), line.size(), "%-8s SILENT    nothing on %s\n", channel.publisher,
                  channel.name);
    return line.data();
  }
  const process_health_t& h = row.health;
  const std::int64_t lost = h.num_dropped + h.num_unpaired + h.num_unsent;
  std::snprintf(line.data(), line.size(),
                "%-8s %-9s %9lld %8lld %6lld %6lld %7lld %10s %7.1f  %s\n", channel.publisher,
                state_name(h), static_cast<long long>(h.num_received),
                static_cast<long long>(h.num_rejected), static_cast<long long>(lost),
                static_cast<long long>(h.num_late), static_cast<long long>(h.num_skipped),
                or_dash(total_p99_ms(h), "%.1f").c_str(), megabytes(h.memory_rss_bytes),
                h.state_reason.c_str());
  return line.data();
}

std::string StatusBoard::motion_text(std::int64_t now_us) const {
  if (!is_recent(motion_.heard_us, kEgoMotion.stale_us, now_us)) return "motion:  no EGO_MOTION\n";
  const ego_motion_t& ego = motion_.newest;
  const auto status = static_cast<std::size_t>(ego.status);
  const double span_s = static_cast<double>(motion_.heard_us - motion_.first_us) * 1e-6;
  const double rate_hz = static_cast<double>(motion_.count - 1) / span_s;
  const double age_ms = ego.capture_mono_us > 0
                            ? static_cast<double>(motion_.heard_us - ego.capture_mono_us) * 1e-3
                            : std::nan("");
  std::array<char, 300> line{};
  std::snprintf(line.data(), line.size(),
                "motion:  %s, %s m/s +- %s, %s images/s, %s ms from capture to here\n",
                status < kEgoMotionStatusNames.size() ? kEgoMotionStatusNames[status] : "?",
                or_dash(ego.velocity_ground_m_s[0], "%.2f").c_str(),
                or_dash(ego.speed_std_m_s, "%.2f").c_str(), or_dash(rate_hz, "%.1f").c_str(),
                or_dash(age_ms, "%.0f").c_str());
  return line.data();
}

std::string StatusBoard::verdict(std::int64_t now_us) const {
  std::string failing;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const char* name = kProcesses[i]->publisher;
    if (is_needed(name) && !runs(i, now_us))
      failing += (failing.empty() ? "" : ", ") + std::string(name);
  }
  return failing.empty() ? "chain:   well\n" : "chain:   NOT WELL: " + failing + "\n";
}

std::string StatusBoard::text(std::int64_t now_us) const {
  std::string out =
      "process  state      received rejected   lost   late skipped  p99 in ms  RSS MB  reason\n";
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].heard_us != 0 || is_needed(kProcesses[i]->publisher)) out += row_text(i, now_us);
  return out + motion_text(now_us) + verdict(now_us);
}

}  // namespace plumb
