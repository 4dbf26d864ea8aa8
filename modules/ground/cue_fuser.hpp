/// Gates and fuses one frame's observations of every cue in kCueTable.
///
/// Memory:
///   There is no state beyond the filter's.
#pragma once

#include <array>

#include "modules/ground/cues/cue.hpp"
#include "modules/ground/filter/plane_filter.hpp"

namespace plumb {

/// One observation for each cue of kCueTable.
using Observations = std::array<Observation, kNumCues>;

/// Tells whether any cue that measures the height has this status.
[[nodiscard]] bool any_height(const Observations& observations, CueStatus status);

/// Initialises the filter from the first cue that is certain enough; else leaves it as it is.
void start_filter(const Observations& observations, PlaneFilter* filter);

/// Fuses the used cues that measure the height, or those that do not. Notes innovation and test
/// ratio in each report, and kGated where the gate rejected the cue. @pre filter->started()
void fuse_cues(bool height_cues, PlaneFilter* filter, Observations* observations);

}  // namespace plumb
