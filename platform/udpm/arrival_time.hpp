/// The time at which a packet reached the socket, on the monotonic clock.
///
/// The kernel stamps packets by the calendar, which may step between the stamp and the reading. A
/// packet cannot have arrived before the socket was last seen empty, nor after now, so the time is
/// kept within these bounds. They hold for a process that was stopped, too: its socket was last
/// seen empty before the stop.
/// Units:
///   [us]
#pragma once

#include <algorithm>
#include <cstdint>

namespace plumb {

class ArrivalTime {
 public:
  /// Nothing can arrive before `opened_us`.
  explicit ArrivalTime(std::int64_t opened_us) : last_empty_us_(opened_us) {}

  /// No packet waited at `now_us`.
  void note_empty(std::int64_t now_us) { last_empty_us_ = now_us; }
  /// The monotonic time of arrival of a packet that is read at `now_us`, which is `calendar_us` on
  /// the calendar, and has the stamp `stamp_us`.
  [[nodiscard]] std::int64_t of(std::int64_t stamp_us, std::int64_t now_us,
                                std::int64_t calendar_us) const {
    const std::int64_t waited_us = std::max<std::int64_t>(calendar_us - stamp_us, 0);
    return std::max(now_us - waited_us, std::min(last_empty_us_, now_us));
  }

 private:
  std::int64_t last_empty_us_;
};

}  // namespace plumb
