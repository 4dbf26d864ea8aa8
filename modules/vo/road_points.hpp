/// Triangulated points below the horizon, for whoever looks for the road.
#pragma once

#include "core/camera_model.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/vo.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

void collect_road_points(const TrackTable& tracks, const Window& window, const Se3& T_cam_world,
                         FixedVector<RoadPoint, kMaxRoadPoints>* points);

}  // namespace plumb::vo
