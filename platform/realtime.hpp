/// What a process asks of the kernel so that its reactions have a bound: memory that stays in RAM,
/// a priority above ordinary programs, and CPUs of its own.
///
/// Errors:
///   What is not permitted is said in a sentence with its remedy, and the process goes on without.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace plumb {

struct RealtimeRequest {
  bool lock_memory = false;
  int priority = 0;                ///< of SCHED_FIFO, 1 to 99; 0 keeps the ordinary scheduler
  std::vector<std::int64_t> cpus;  ///< empty: those it was started with
};

/// Before anything is built: binds this thread, and those that it will start, to the CPUs. A
/// process that will lock its memory also gets one heap for all threads, which keeps what is freed,
/// and threads with small stacks. Returns the sentences.
[[nodiscard]] std::vector<std::string> prepare_realtime(const RealtimeRequest& request);

/// After all is built: touches the stack and locks what the process has and will have, then raises
/// the priority of this thread alone. Returns the sentences.
[[nodiscard]] std::vector<std::string> enter_realtime(const RealtimeRequest& request);

}  // namespace plumb
