/// Judges whether the output of a process is what it should be, which is more than that its loop
/// turns. A watchdog is fed by it.
///
/// Rule:
///   Output is due when every periodic input has brought a message that was accepted, or always
///   when the process publishes by a clock. It is excused while the process itself says what it
///   lacks: a calibration, its camera, its bus. A process that is degraded otherwise owes it. What
///   is due must have been published since the last time that all was well.
#pragma once

#include <cstdint>

#include "platform/bus.hpp"

namespace plumb {

class OutputWatch {
 public:
  /// `is_cyclic`: the process publishes whether or not anything arrives.
  explicit OutputWatch(bool is_cyclic) : is_cyclic_(is_cyclic) {}

  /// Returns whether all is well now. `is_excused`: the process said what it lacks.
  bool judge(std::int64_t now_us, const Bus& bus, const Counters& counters, bool is_excused);

 private:
  [[nodiscard]] bool is_due(const Bus& bus) const;

  bool is_cyclic_;
  std::int64_t well_us_ = 0;  ///< when all was well for the last time
  std::int64_t num_published_ = 0;
};

}  // namespace plumb
