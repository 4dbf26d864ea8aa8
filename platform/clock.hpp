/// The clocks of the machine. Only this file reads them; estimators use capture_us as their time.
///
/// Threads:
///   Every function may be called from any thread.
#pragma once

#include <cstdint>
#include <ctime>

namespace plumb {

/// [us] CLOCK_MONOTONIC, which never steps and has no relation to the calendar.
[[nodiscard]] inline std::int64_t monotonic_us() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000 + t.tv_nsec / 1'000;
}

/// [us] CLOCK_REALTIME since 1970, for time stamps that are compared across machines. It may step.
[[nodiscard]] inline std::int64_t realtime_us() {
  timespec t{};
  clock_gettime(CLOCK_REALTIME, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000 + t.tv_nsec / 1'000;
}

/// [ns] CLOCK_MONOTONIC, for the durations of stages.
[[nodiscard]] inline std::int64_t monotonic_ns() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000'000 + t.tv_nsec;
}

/// [us] Processor time that all threads of this process have used.
/// Other processes do not affect it.
[[nodiscard]] inline std::int64_t process_cpu_us() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000 + t.tv_nsec / 1'000;
}

}  // namespace plumb
