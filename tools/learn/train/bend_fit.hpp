/// How roads bend (RoadBend), out of samples with true planes: the true plane ahead against the direction of travel.
#pragma once

#include <optional>
#include <vector>

#include "modules/ground/filter/road_bend.hpp"
#include "tools/learn/train/sample_file.hpp"

namespace plumb {

/// Root mean square of the bend, its memory, and the line through ln(true over nominal height) against it. The angle
/// between plane and travel is taken for the bend: the noise of the direction of travel, about a tenth of it, makes the
/// slope smaller by a hundredth. Null without enough frames that have a true plane.
[[nodiscard]] std::optional<RoadBend> fit_bend(const std::vector<DriveSamples>& drives);

}  // namespace plumb
