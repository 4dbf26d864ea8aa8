/// Draws the results for a frame onto it: road grid, horizon, objects, features, figures and path.
///
/// Frames:
///   cam: x right, y down, z forward. The plane's normal points DOWN: n . X = h.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/camera_model.hpp"
#include "modules/vo/vo.hpp"

namespace plumb {

struct PlaneFigure {
  Eigen::Vector3d normal_cam = Eigen::Vector3d::UnitY();  ///< unit, down
  double height_m = 0.0;
};

/// A box that stands on the road. ground: x forward, y left, z up, on the road under the camera.
struct ObjectFigure {
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();  ///< middle of the footprint
  double yaw_rad = 0.0;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< length, width, height
  bool measured = false;                             ///< else predicted
  std::string label;
};

struct FrameFigures {
  std::optional<PlaneFigure> plane;     ///< absent while it is not valid
  std::vector<Eigen::Vector2d> path_m;  ///< (x right, z forward) of the world frame, oldest first
  std::vector<ObjectFigure> objects;    ///< drawn where the plane is valid
  std::vector<Feature> features;        ///< the key names their kinds when there are any
  std::vector<std::string> lines;       ///< text, top to bottom
};

/// Colour picture of `grey` with everything in `figures` drawn on it, and below it a strip with the
/// text and a key of the colours.
[[nodiscard]] cv::Mat draw_overlay(const cv::Mat& grey, const CameraModel& camera,
                                   const FrameFigures& figures);

/// Pixel where the plane's vanishing line crosses the column through the principal point.
[[nodiscard]] double horizon_row_px(const CameraModel& camera, const PlaneFigure& plane);

}  // namespace plumb
