/// Places an object by the foot point of its box alone: eq. (2) for the lower middle of the box,
/// plus half the usual length of its class.
#pragma once

#include "modules/detections/foot_point.hpp"
#include "modules/objects/objects_config.hpp"

namespace plumb {

/// The middle of the footprint in cam as (Z, X) [m]. A foot point at or above the horizon counts as
/// three times too far.
[[nodiscard]] Eigen::Vector2d place_by_foot(const CameraModel& camera, const RoadPlane& road,
                                            const Box& box, const FootprintPrior& size,
                                            double truth_m);

}  // namespace plumb
