/// The state of a box-shaped object on the road and its projection to an image box.
///
/// Frames:
///   ground: x forward, y left, z up, on the road under the camera; yaw about z, left positive.
/// Units:
///   SI, and pixels for image boxes.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "core/camera_model.hpp"
#include "modules/detections/road_plane.hpp"

namespace plumb {

/// Rows of an object's state vector.
enum StateRow : int {
  kX = 0,
  kY = 1,
  kVelocityX = 2,
  kVelocityY = 3,
  kYaw = 4,
  kLogWidth = 5,
  kLogRatio = 6,  ///< ln(length / width)
  kLogHeight = 7,
  kPlaneError = 8,  ///< [rad] pitch of the road under the object minus the pitch of the plane
  kStateSize = 9,
};
using StateVector = Eigen::Matrix<double, kStateSize, 1>;
using StateMatrix = Eigen::Matrix<double, kStateSize, kStateSize>;

[[nodiscard]] inline double width_of(const StateVector& x) { return std::exp(x(kLogWidth)); }
[[nodiscard]] inline double length_of(const StateVector& x) {
  return std::exp(x(kLogWidth) + x(kLogRatio));
}
[[nodiscard]] inline double height_of(const StateVector& x) { return std::exp(x(kLogHeight)); }

/// The left, top, right and bottom edge of a cuboid's image, and their Jacobians.
struct ProjectedCuboid {
  Eigen::Vector4d edges_px = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, 4, kStateSize> J_state = Eigen::Matrix<double, 4, kStateSize>::Zero();
  Eigen::Matrix<double, 4, 3> J_plane =
      Eigen::Matrix<double, 4, 3>::Zero();            ///< (pitch, roll, ln height)
  Eigen::Vector4d J_inset = Eigen::Vector4d::Zero();  ///< (contact inset)
};

/// Projects the cuboid; its outermost corners determine the edges. The bottom edge is that of the
/// points of contact, which are `contact_inset_m` inside the outline. Returns nothing when a corner
/// is not in front of the camera.
[[nodiscard]] std::optional<ProjectedCuboid> project_cuboid(const CameraModel& camera,
                                                            const RoadPlane& plane,
                                                            const StateVector& state,
                                                            double contact_inset_m);

}  // namespace plumb
