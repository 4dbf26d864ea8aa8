/// Where the foot point of a box alone puts an object: eq. (2) of the box's lower middle, half a class's length added.
#pragma once

#include "modules/detections/foot_point.hpp"
#include "modules/objects/objects_config.hpp"

namespace plumb {

/// Middle of the footprint in cam as (Z, X) [m]. A foot point at the horizon counts as three times too far.
[[nodiscard]] Eigen::Vector2d place_by_foot(const CameraModel& camera, const RoadPlane& road,
                                            const Box& box, const FootprintPrior& size,
                                            double truth_m);

}  // namespace plumb
