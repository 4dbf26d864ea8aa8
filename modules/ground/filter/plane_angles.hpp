/// Pitch, roll and ground axes from the road's normal in the camera.
///
/// ISO 8855 angles: R_ground_veh = Rz(yaw) Ry(pitch) Rx(roll) with x forward, y left, z up, so that
/// pitch is positive nose DOWN and roll is positive right side down. With the vehicle's axes x =
/// cam z, y = -cam x, z = -cam y and a normal that points down,
///   n = (cos p sin r, cos p cos r, sin p).
///
/// Frames:
///   cam: x right, y down, z forward.
///   ground: x forward, y left, z up.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/numbers.hpp"
#include "core/se3.hpp"

namespace plumb {

/// @pre |normal_cam| = 1
[[nodiscard]] inline double pitch_of(const Eigen::Vector3d& normal_cam) {
  return std::atan2(normal_cam.z(), root_sum_square(normal_cam.x(), normal_cam.y()));
}

/// @pre |normal_cam| = 1
[[nodiscard]] inline double roll_of(const Eigen::Vector3d& normal_cam) {
  return std::atan2(normal_cam.x(), normal_cam.y());
}

/// d(pitch, roll)/d(n1, n3) on the unit sphere.
[[nodiscard]] inline Eigen::Matrix2d angles_jacobian(const Eigen::Vector3d& normal_cam) {
  const double n1 = normal_cam.x(), n2 = normal_cam.y(), n3 = normal_cam.z();
  const double across2 = n1 * n1 + n2 * n2;
  Eigen::Matrix2d J;
  // n2 follows n1 and n3: dn2 = -(n1 dn1 + n3 dn3) / n2.
  J << 0.0, 1.0 / std::sqrt(across2), (n2 + n1 * n1 / n2) / across2, n1 * n3 / (n2 * across2);
  return J;
}

/// Ground axes in which the camera looks along x: yaw is zero by definition.
[[nodiscard]] inline Eigen::Matrix3d rotation_ground_cam(const Eigen::Vector3d& normal_cam) {
  const Eigen::Vector3d up = -normal_cam;
  const Eigen::Vector3d forward =
      (Eigen::Vector3d::UnitZ() - normal_cam * normal_cam.z()).normalized();
  const Eigen::Vector3d left = up.cross(forward);
  Eigen::Matrix3d R;
  R << forward.transpose(), left.transpose(), up.transpose();
  return R;
}

}  // namespace plumb
