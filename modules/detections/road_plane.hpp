/// The road under the camera as pitch, roll and height, with their covariance.
///
/// Frames:
///   cam: x right, y down, z forward. The normal points DOWN to the road: normal . X = height.
///   ground: x forward, y left, z up, on the road under the camera; the camera looks along x.
/// Angles:
///   ISO 8855: pitch nose DOWN positive, roll right side down positive;
///   normal = (cos p sin r, cos p cos r, sin p).
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace plumb {

struct RoadPlane {
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
  double height_m = 0.0;                          ///< > 0
  Eigen::Matrix3d cov = Eigen::Matrix3d::Zero();  ///< of (pitch, roll, ln height)

  [[nodiscard]] Eigen::Vector3d normal_cam() const {
    return {std::cos(pitch_rad) * std::sin(roll_rad), std::cos(pitch_rad) * std::cos(roll_rad),
            std::sin(pitch_rad)};
  }

  /// Its rows are the ground axes in cam: forward, left and up.
  [[nodiscard]] Eigen::Matrix3d R_ground_cam() const {
    const double cp = std::cos(pitch_rad), sp = std::sin(pitch_rad);
    const double cr = std::cos(roll_rad), sr = std::sin(roll_rad);
    Eigen::Matrix3d R;
    R << -sp * sr, -sp * cr, cp, -cr, sr, 0.0, -cp * sr, -cp * cr, -sp;
    return R;
  }

  [[nodiscard]] Eigen::Vector3d ground_from_cam(const Eigen::Vector3d& p_cam) const {
    return R_ground_cam() * p_cam + Eigen::Vector3d(0.0, 0.0, height_m);
  }

  [[nodiscard]] Eigen::Vector3d cam_from_ground(const Eigen::Vector3d& p_ground) const {
    return R_ground_cam().transpose() * (p_ground - Eigen::Vector3d(0.0, 0.0, height_m));
  }
};

}  // namespace plumb
