/// Faults of camera, clock and source, as sequences of images made of a sound drive.
///
/// Units:
///   microseconds, m/s.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/evaluate/faults/fault_run.hpp"

namespace plumb {

/// A row of the fault matrix.
struct Fault {
  std::string name;
  char kind = 'A';       ///< letter of the kind, see docs/faults.md
  std::string injected;  ///< what is done to the drive, in words
  std::function<FaultRun(const FaultDrive&)> make;
};

/// Every fault that can be put into a recorded drive. The first row is the sound drive.
[[nodiscard]] const std::vector<Fault>& all_faults();

}  // namespace plumb
