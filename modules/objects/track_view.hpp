/// The inputs that every track shares in one image.
///
/// Frames:
///   ground: x forward, y left, z up, on the road under the camera.
/// Units:
///   SI.
#pragma once

#include <Eigen/Core>

#include "core/camera_model.hpp"
#include "modules/detections/detections_config.hpp"
#include "modules/detections/road_plane.hpp"
#include "modules/objects/objects_config.hpp"

namespace plumb {

/// The motion of the ground axes from one image to the next.
struct GroundMotion {
  double dt_s = 0.0;
  /// When false, the camera's motion is unknown: t_m and yaw_rad are not valid, and velocities are
  /// relative to the camera.
  bool known = false;
  Eigen::Vector2d t_m = Eigen::Vector2d::Zero();  ///< new origin in the old axes
  double yaw_rad = 0.0;                           ///< new axes against the old ones, left positive
};

/// Everything that a track needs to interpret a box.
struct TrackView {
  const DetectionsConfig& detections;
  const ObjectsConfig& objects;
  const CameraModel& camera;
  RoadPlane plane;
};

}  // namespace plumb
