/// Fits how roads bend (RoadBend) from samples with true planes: the true plane ahead against the
/// direction of translation.
#pragma once

#include <optional>
#include <vector>

#include "modules/ground/filter/road_bend.hpp"
#include "tools/learn/train/sample_file.hpp"

namespace plumb {

/// Fits the bend's root mean square, its correlation length, and the slope of ln(true over nominal
/// height) against it. The angle between plane and direction of translation is taken as the bend;
/// the noise of that direction, about a tenth of it, makes the slope smaller by a hundredth. Null
/// without enough frames that have a true plane.
[[nodiscard]] std::optional<RoadBend> fit_bend(const std::vector<DriveSamples>& drives);

}  // namespace plumb
