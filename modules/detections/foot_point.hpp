/// Where a box stands on the road, how tall it is, and which pitch its height asks for.
///
/// Frames  cam and ground as in road_plane.hpp, img as in detection.hpp. The foot is the middle of
/// the
///         box's lower edge, the head the point above it on the upper edge.
/// Source  Song and Chandraker, CVPR 2014, eqs. (2) and (9).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/camera_model.hpp"
#include "modules/detections/road_plane.hpp"

namespace plumb {

/// Undistorted normalised coordinates of a pixel and their Jacobian.
struct NormalizedPixel {
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();
  Eigen::Matrix2d J_px = Eigen::Matrix2d::Zero();
};
[[nodiscard]] NormalizedPixel normalize_pixel(const CameraModel& camera, const Eigen::Vector2d& px);

/// A pixel put onto the road.
struct FootPoint {
  Eigen::Vector3d p_cam = Eigen::Vector3d::Zero();                         ///< [m]
  Eigen::Matrix<double, 3, 2> J_px = Eigen::Matrix<double, 3, 2>::Zero();  ///< d p_cam / d (u, v)
  Eigen::Matrix3d J_plane = Eigen::Matrix3d::Zero();     ///< d p_cam / d (pitch, roll, ln height)
  Eigen::Matrix3d cov_cam_m2 = Eigen::Matrix3d::Zero();  ///< pixel and plane
};

/// Eq. (2), B = h K^-1 b / (n . K^-1 b). Nothing when the ray does not meet the road in front of
/// the camera.
[[nodiscard]] std::optional<FootPoint> back_project_foot(const CameraModel& camera,
                                                         const RoadPlane& plane,
                                                         const Eigen::Vector2d& foot_px,
                                                         const Eigen::Matrix2d& cov_px2);

/// Height of an upright object over the road.
struct HeightEstimate {
  double height_m = 0.0;
  Eigen::Vector3d J_px = Eigen::Vector3d::Zero();     ///< d height / d (u, v_foot, v_head)
  Eigen::Vector3d J_plane = Eigen::Vector3d::Zero();  ///< d height / d (pitch, roll, ln height)
  double var_m2 = 0.0;                                ///< pixel and plane
};

/// The point above the foot that is seen in row `head_v_px`; cov_px2 is of (u, v_foot, v_head).
/// Nothing when the foot is not on the road or the result is not above it.
[[nodiscard]] std::optional<HeightEstimate> object_height(const CameraModel& camera,
                                                          const RoadPlane& plane,
                                                          const Eigen::Vector2d& foot_px,
                                                          double head_v_px,
                                                          const Eigen::Matrix3d& cov_px2);

/// The pitch at which a box of known height is as tall as it looks.
struct PitchFromBox {
  double pitch_rad = 0.0;
  Eigen::Vector3d J_px = Eigen::Vector3d::Zero();  ///< d pitch / d (u, v_foot, v_head)
  double J_roll = 0.0;                             ///< d pitch / d roll
  double J_log_ratio = 0.0;  ///< d pitch / d ln(object height / camera height)
};

/// Eq. (9) in closed form: with k = object height / camera height, y the rows in normalised
/// coordinates turned upright by `roll_rad`, and y_h the horizon's,
///   k (y_foot - y_h) (1 + y_head y_h) = (y_foot - y_head) (1 + y_h^2),   tan(pitch) = -y_h.
/// Nothing when the box is not upright or no plane below the camera explains it.
[[nodiscard]] std::optional<PitchFromBox> pitch_from_box(const CameraModel& camera, double roll_rad,
                                                         const Eigen::Vector2d& foot_px,
                                                         double head_v_px, double height_ratio);

}  // namespace plumb
