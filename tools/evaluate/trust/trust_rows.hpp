/// Runs that ask whether the scale is known as well as it is said to be: starts in the middle of a
/// drive, fast cars, gaps, and a road that shows nothing for long.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/evaluate/faults/fault_run.hpp"

namespace plumb {

/// A row of the table: several runs, whose images are judged together.
struct TrustRow {
  std::string name;
  std::string done;          ///< what is done to the drive, in words
  std::size_t speed_up = 1;  ///< every how many-th image of the drive is used
  std::function<std::vector<FaultRun>(const FaultDrive&)> make;
};

[[nodiscard]] const std::vector<TrustRow>& all_trust_rows();

}  // namespace plumb
