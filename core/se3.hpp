/// Rotations and rigid transforms.
///
/// Frames:
///   T_a_b maps coordinates in b to coordinates in a: p_a = T_a_b * p_b. R_a_b is its rotation, and
///   t_a_b is the origin of b in a.
/// Perturbation:
///   Tangent vectors are ordered (translation, rotation). Rotations are perturbed on the right,
///   R <- R exp(w^), unless a function says otherwise.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace plumb {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Skew-symmetric matrix of a vector: hat(a) * b == a.cross(b).
[[nodiscard]] inline Eigen::Matrix3d hat(const Eigen::Vector3d& w) {
  Eigen::Matrix3d m;
  m << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  return m;
}

/// Rotation matrix of the rotation vector `w_rad` (Rodrigues' formula).
[[nodiscard]] inline Eigen::Matrix3d exp_so3(const Eigen::Vector3d& w_rad) {
  const double angle2 = w_rad.squaredNorm();
  const Eigen::Matrix3d W = hat(w_rad);
  if (angle2 < 1e-16) return Eigen::Matrix3d::Identity() + W;
  const double angle = std::sqrt(angle2);
  return Eigen::Matrix3d::Identity() + (std::sin(angle) / angle) * W +
         ((1.0 - std::cos(angle)) / angle2) * (W * W);
}

/// Rotation vector of `R`; its norm is in [0, pi].
[[nodiscard]] inline Eigen::Vector3d log_so3(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const double n = q.vec().norm();
  if (n < 1e-12) return 2.0 * q.vec() * (q.w() < 0.0 ? -1.0 : 1.0);
  const double w = q.w() < 0.0 ? -q.w() : q.w();
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  return (sign * 2.0 * std::atan2(n, w) / n) * q.vec();
}

/// A rigid transform, by default the identity.
struct Se3 {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  [[nodiscard]] Se3 inverse() const { return {R.transpose(), -(R.transpose() * t)}; }
  [[nodiscard]] Se3 operator*(const Se3& other) const { return {R * other.R, R * other.t + t}; }
  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return R * p + t; }

  /// Projects R back onto SO(3). Call this after long products, whose rounding errors add up.
  void normalize() { R = Eigen::Quaterniond(R).normalized().toRotationMatrix(); }
};

}  // namespace plumb
