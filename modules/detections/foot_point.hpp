/// Where a box touches the road, and which camera pitch its height implies.
///
/// Frames:
///   cam and ground as in road_plane.hpp, img as in detection.hpp. The foot of a box is the middle
///   of its lower edge; its head is the point above the foot on the upper edge.
/// Source:
///   Song and Chandraker, CVPR 2014, eqs. (2) and (9).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/camera_model.hpp"
#include "modules/detections/road_plane.hpp"

namespace plumb {

/// Back-projects a pixel onto the road, eq. (2): B = h K^-1 b / (n . K^-1 b). Returns the point in
/// cam [m], or nothing when the ray does not meet the road in front of the camera.
[[nodiscard]] std::optional<Eigen::Vector3d> back_project_foot(const CameraModel& camera,
                                                               const RoadPlane& plane,
                                                               const Eigen::Vector2d& foot_px);

/// The pitch at which an object of known height appears as tall as its box.
struct PitchFromBox {
  double pitch_rad = 0.0;
  Eigen::Vector3d J_px = Eigen::Vector3d::Zero();  ///< d pitch / d (u, v_foot, v_head)
  double J_roll = 0.0;                             ///< d pitch / d roll
  double J_log_ratio = 0.0;  ///< d pitch / d ln(object height / camera height)
};

/// Solves eq. (9) in closed form. With k = object height / camera height, y the rows in normalised
/// coordinates after the image is rotated by `roll_rad`, and y_h the row of the horizon,
///   k (y_foot - y_h) (1 + y_head y_h) = (y_foot - y_head) (1 + y_h^2),   tan(pitch) = -y_h.
/// Returns nothing when the box is not upright or no plane below the camera explains it.
[[nodiscard]] std::optional<PitchFromBox> pitch_from_box(const CameraModel& camera, double roll_rad,
                                                         const Eigen::Vector2d& foot_px,
                                                         double head_v_px, double height_ratio);

}  // namespace plumb
