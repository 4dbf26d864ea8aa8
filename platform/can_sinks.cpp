#include "platform/can_sinks.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace plumb {
namespace {

/// A loss is told for this long, and no more often.
constexpr std::int64_t kTellUs = 1'000'000;

}  // namespace

const std::string& CanSinks::open(const std::string& interface, const std::string& trace_path,
                                  std::int64_t offset_us, SocketCan::Opener opener) {
  if (!interface.empty()) bus_.emplace(interface, opener);
  trace_path_ = trace_path;
  if (!trace_path.empty())
    trace_.emplace(trace_path, interface.empty() ? "can0" : interface, offset_us);
  return trace_error();
}

void CanSinks::service(std::int64_t now_us) {
  if (bus_) bus_->service(now_us);
  write_trouble(now_us);
}

void CanSinks::send(std::int64_t time_us, const CanFrame& frame) {
  if (bus_) bus_->send(time_us, frame);
  if (trace_) trace_->send(time_us, frame);
}

std::int64_t CanSinks::num_sent() const {
  if (bus_) return bus_->counters().num_sent;
  return trace_ ? trace_->num_frames() : 0;
}

std::int64_t CanSinks::num_unsent() const { return bus_ ? bus_->counters().num_unsent : 0; }

const std::string& CanSinks::trace_error() const { return trace_ ? trace_->error() : nothing_; }

void CanSinks::write_trouble(std::int64_t now_us) {
  if (num_dropped() > told_dropped_ && now_us - drop_told_us_ >= kTellUs) {
    told_dropped_ = num_dropped();
    drop_told_us_ = now_us;
  }
  const bool is_dropping = told_dropped_ > 0 && now_us - drop_told_us_ < kTellUs;
  std::array<char, sizeof trouble_> text{};
  std::size_t used = 0;
  const auto add = [&](const char* sentence) {
    if (*sentence == '\0') return;
    const int n = std::snprintf(text.data() + used, text.size() - used, "%s%s",
                                used > 0 ? "; " : "", sentence);
    used = std::min(text.size() - 1, used + static_cast<std::size_t>(n));
  };
  std::array<char, 160> dropped{};
  std::snprintf(dropped.data(), dropped.size(), "%.80s: too slow, %lld frames are missing",
                trace_path_.c_str(), static_cast<long long>(told_dropped_));
  if (bus_) add(bus_->state().c_str());
  add(trace_error().c_str());
  if (is_dropping) add(dropped.data());
  trouble_changed_ = std::strcmp(text.data(), trouble_.data()) != 0;
  trouble_ = text;
}

}  // namespace plumb
