#include "modules/ground/cue_fuser.hpp"

#include <cmath>

namespace plumb {
bool any_height(const Observations& observations, CueStatus status) {
  for (std::size_t i = 0; i < kNumCues; ++i) {
    if (kCueTable[i].measures_height && observations[i].report.status == status) return true;
  }
  return false;
}

void start_filter(const Observations& observations, PlaneFilter* filter) {
  for (const Observation& observation : observations) {
    if (std::isnan(observation.start_ln_height)) continue;
    filter->start(observation.prior.normal_cam, observation.start_ln_height);
    return;
  }
}

void fuse_cues(bool height_cues, PlaneFilter* filter, Observations* observations) {
  for (std::size_t i = 0; i < kNumCues; ++i) {
    Observation& observation = (*observations)[i];
    if (kCueTable[i].measures_height != height_cues) continue;
    if (observation.report.status != CueStatus::kUsed) continue;
    const FuseResult result = filter->fuse(observation.plane);
    observation.report.innovation = result.innovation;
    observation.report.test_ratio = result.test_ratio;
    if (!result.accepted) observation.report.status = CueStatus::kGated;
  }
}

}  // namespace plumb
