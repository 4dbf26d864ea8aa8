/// Boxes of cars on a level road, as a camera of a given pitch sees them.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "core/camera_model.hpp"
#include "modules/detections/detection.hpp"
#include "modules/detections/detections_config.hpp"
#include "modules/detections/road_plane.hpp"
#include "tests/ground/road_scene.hpp"

namespace plumb::test {

inline constexpr double kCarHalfWidth_m = 0.85;

/// A car of `height_m` whose rear stands `ahead_m` in front of a camera without roll.
inline Detection car_at(const CameraModel& camera, double pitch_rad, double ahead_m, double left_m,
                        double height_m) {
  const RoadPlane road{pitch_rad, 0.0, kRoadHeight};
  const Eigen::Vector2d foot = camera.project(road.cam_from_ground({ahead_m, left_m, 0.0}));
  // (9) has the head above the foot in the direction of the road's normal.
  const Eigen::Vector2d head = camera.project(road.cam_from_ground({ahead_m, left_m, height_m}));
  const double half_px = camera.fx_px * kCarHalfWidth_m / ahead_m;
  Detection car;
  car.object_class = ObjectClass::kCar;
  car.score = 0.9;
  car.occluded = Occlusion::kVisible;
  car.box = {foot.x() - half_px, head.y(), foot.x() + half_px, foot.y()};
  return car;
}

/// One car of the class's mean height at each distance, left and right in turn.
inline DetectionFrame cars_at_pitch(const CameraModel& camera, double pitch_rad,
                                    const std::vector<double>& ahead_m) {
  DetectionFrame frame;
  double left_m = 2.0;
  for (const double ahead : ahead_m) {
    (void)frame.detections.push_back(
        car_at(camera, pitch_rad, ahead, left_m, DetectionsConfig{}.car.mean_m));
    left_m = -left_m;
  }
  return frame;
}

}  // namespace plumb::test
