/// Upright objects on a known road with the boxes of an ideal detector. A box ends at the foot and
/// the head of its object's centre, so that eq. (9) is exact.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/camera_model.hpp"
#include "core/numbers.hpp"
#include "modules/detections/detection.hpp"
#include "modules/detections/road_plane.hpp"

namespace plumb::test {

inline const CameraModel kSceneCamera{1242, 375, 721.5, 721.5, 609.6, 172.9, 0.0, 0.0, 1.65};

struct SceneObject {
  std::int32_t track_id = 0;
  double x_m = 0.0;  ///< distance ahead
  double y_m = 0.0;  ///< distance to the left
  double height_m = 1.53;
  ObjectClass object_class = ObjectClass::kCar;
  double width_m = 1.6;
};

inline RoadPlane road(double pitch_rad, double roll_rad = 0.0) {
  RoadPlane plane;
  plane.pitch_rad = pitch_rad;
  plane.roll_rad = roll_rad;
  plane.height_m = 1.65;
  return plane;
}

inline Detection seen_one(const SceneObject& object, const RoadPlane& plane) {
  const Eigen::Vector3d foot = plane.cam_from_ground({object.x_m, object.y_m, 0.0});
  const Eigen::Vector3d head = plane.cam_from_ground({object.x_m, object.y_m, object.height_m});
  const Eigen::Vector2d foot_px = kSceneCamera.project(foot);
  const double half_px = 0.5 * object.width_m * kSceneCamera.fx_px / foot.z();
  Detection detection;
  detection.track_id = object.track_id;
  detection.object_class = object.object_class;
  detection.score = 0.9;
  detection.box = {foot_px.x() - half_px, kSceneCamera.project(head).y(), foot_px.x() + half_px,
                   foot_px.y()};
  detection.truncated_ratio = kNan;
  return detection;
}

inline DetectionFrame seen(const std::vector<SceneObject>& objects, const RoadPlane& plane,
                           std::int64_t capture_us = 0) {
  DetectionFrame frame;
  frame.capture_us = capture_us;
  for (const SceneObject& object : objects) {
    if (!frame.detections.push_back(seen_one(object, plane))) break;
  }
  return frame;
}

/// Six cars at 15 to 60 m of which none hides another.
inline std::vector<SceneObject> six_cars() {
  return {{1, 15.0, 5.5}, {2, 22.0, 1.5},   {3, 30.0, -3.5},
          {4, 38.0, 8.5}, {5, 46.0, -11.5}, {6, 60.0, -0.5}};
}

/// Adds independent noise to all four edges.
inline void shake(DetectionFrame* frame, double std_px, std::mt19937* random) {
  std::normal_distribution<double> normal(0.0, std_px);
  for (Detection& d : frame->detections) {
    d.box.left_px += normal(*random);
    d.box.top_px += normal(*random);
    d.box.right_px += normal(*random);
    d.box.bottom_px += normal(*random);
  }
}

}  // namespace plumb::test
