/// Selection of the triangulated points that may lie on the road.
#pragma once

#include "core/camera_model.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/vo.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

/// Collects the active tracks below the horizon whose depth is known, in the order of the table,
/// until `points` is full. The road itself is not recognised here; the ground estimator does that.
/// @param T_cam_world  pose of the newest image
void collect_road_points(const TrackTable& tracks, const Window& window, const Se3& T_cam_world,
                         FixedVector<RoadPoint, kMaxRoadPoints>* points);

}  // namespace plumb::vo
