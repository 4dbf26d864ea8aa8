/// The events of a run, oldest first, for several readers in other threads.
///
/// Memory:
///   The newest kMaxEvents; older ones are forgotten.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/monitor/event_watch.hpp"

namespace plumb {

class EventLog {
 public:
  static constexpr std::size_t kMaxEvents = 500;

  /// `frame` is the number of the frame that the page jumps to; -1: none.
  void add(double time_s, std::int64_t frame, EventLevel level, const char* source,
           const std::string& text) {
    const std::lock_guard lock(mutex_);
    events_.push_back({{"serial", num_events_++},
                       {"time_s", time_s},
                       {"frame", frame},
                       {"level", kEventLevelNames[static_cast<std::size_t>(level)]},
                       {"source", source},
                       {"text", text}});
    if (events_.size() > kMaxEvents) events_.pop_front();
  }

  /// The events from number `*cursor` on, which moves behind the last of them.
  [[nodiscard]] nlohmann::json since(std::int64_t* cursor) const {
    const std::lock_guard lock(mutex_);
    nlohmann::json list = nlohmann::json::array();
    const auto first = num_events_ - static_cast<std::int64_t>(events_.size());
    for (std::int64_t i = std::max(*cursor, first); i < num_events_; ++i)
      list.push_back(events_[static_cast<std::size_t>(i - first)]);
    *cursor = num_events_;
    return list;
  }
  [[nodiscard]] std::int64_t num_events() const {
    const std::lock_guard lock(mutex_);
    return num_events_;
  }

 private:
  mutable std::mutex mutex_;
  std::deque<nlohmann::json> events_;
  std::int64_t num_events_ = 0;
};

}  // namespace plumb
