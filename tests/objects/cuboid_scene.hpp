/// Cuboids on a known road and the boxes around their images.
#pragma once

#include <cmath>

#include "modules/objects/cuboid.hpp"
#include "tests/detections/road_scene.hpp"

namespace plumb::test {

/// A car of 4.0 x 1.67 x 1.53 m.
inline StateVector car_at(double x_m, double y_m, double yaw_rad) {
  StateVector state = StateVector::Zero();
  state(kX) = x_m;
  state(kY) = y_m;
  state(kYaw) = yaw_rad;
  state(kLogWidth) = std::log(1.67);
  state(kLogRatio) = std::log(2.4);
  state(kLogHeight) = std::log(1.53);
  return state;
}

inline constexpr double kSceneInset_m = 0.2;

/// The detection of an ideal detector, cut at the border of the image.
inline Detection detect(const StateVector& state, const RoadPlane& plane, std::int32_t track_id) {
  const auto seen = project_cuboid(kSceneCamera, plane, state, kSceneInset_m);
  Detection detection;
  detection.track_id = track_id;
  detection.object_class = ObjectClass::kCar;
  detection.score = 0.9;
  detection.box = {std::max(seen->edges_px(0), 0.0), std::max(seen->edges_px(1), 0.0),
                   std::min(seen->edges_px(2), kSceneCamera.width_px - 1.0),
                   std::min(seen->edges_px(3), kSceneCamera.height_px - 1.0)};
  return detection;
}

}  // namespace plumb::test
