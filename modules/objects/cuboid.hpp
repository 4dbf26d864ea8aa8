/// A box-shaped object on the road, and the image box it is seen in.
///
/// Frames  ground: x forward, y left, z up, on the road under the camera; yaw about z, left positive.
/// Units   SI, pixels for image boxes.
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
  kPlaneError = 8,  ///< [rad] pitch of the road where the object stands, less the plane's
  kStateSize = 9,
};
using StateVector = Eigen::Matrix<double, kStateSize, 1>;
using StateMatrix = Eigen::Matrix<double, kStateSize, kStateSize>;

[[nodiscard]] inline double width_of(const StateVector& x) { return std::exp(x(kLogWidth)); }
[[nodiscard]] inline double length_of(const StateVector& x) {
  return std::exp(x(kLogWidth) + x(kLogRatio));
}
[[nodiscard]] inline double height_of(const StateVector& x) { return std::exp(x(kLogHeight)); }

/// Left, top, right and lower edge, and what they depend on.
struct SeenCuboid {
  Eigen::Vector4d edges_px = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, 4, kStateSize> J_state = Eigen::Matrix<double, 4, kStateSize>::Zero();
  Eigen::Matrix<double, 4, 3> J_plane =
      Eigen::Matrix<double, 4, 3>::Zero();            ///< (pitch, roll, ln height)
  Eigen::Vector4d J_inset = Eigen::Vector4d::Zero();  ///< (contact inset)
};

/// The outermost corners of the cuboid in the image. The lower edge is that of the contact points,
/// which lie `contact_inset_m` inside the outline. Nothing when a corner is not in front of the
/// camera.
[[nodiscard]] std::optional<SeenCuboid> see_cuboid(const CameraModel& camera,
                                                   const RoadPlane& plane, const StateVector& state,
                                                   double contact_inset_m);

}  // namespace plumb
