/// One frame's cues as GROUND_PLANE reports them: what each saw, and with which deviation.
#pragma once

#include <array>

#include "modules/ground/covariance/cue_covariance.hpp"
#include "modules/ground/covariance/ground_sight.hpp"

namespace plumb {

[[nodiscard]] std::array<CueObservation, kNumCues> observations_of(const GroundSight& sight,
                                                                   const CueCovariance& covariance);

}  // namespace plumb
