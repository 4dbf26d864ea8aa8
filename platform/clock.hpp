/// The one place that asks the machine for the time. Estimators never do: their time is capture_us.
#pragma once

#include <cstdint>
#include <ctime>

namespace plumb {

/// [us] CLOCK_MONOTONIC: steady, unrelated to the calendar.
[[nodiscard]] inline std::int64_t monotonic_us() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000 + t.tv_nsec / 1'000;
}

/// [us] since 1970, CLOCK_REALTIME: for time stamps that people compare across machines; it may jump.
[[nodiscard]] inline std::int64_t realtime_us() {
  timespec t{};
  clock_gettime(CLOCK_REALTIME, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000 + t.tv_nsec / 1'000;
}

/// [ns] CLOCK_MONOTONIC, for stage times.
[[nodiscard]] inline std::int64_t monotonic_ns() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000'000 + t.tv_nsec;
}

/// [us] processor time of this process so far, all threads: what work costs, however busy the machine is.
[[nodiscard]] inline std::int64_t process_cpu_us() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000 + t.tv_nsec / 1'000;
}

}  // namespace plumb
