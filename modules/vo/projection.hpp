/// How an inverse-depth point moves between frames, and the derivatives all estimators here share.
///
/// A point with host ray m = (x, y, 1) and inverse depth rho is Y = R m + rho t in another frame, up to a factor.
/// Residuals are pixels: r = f (z - Y_xy / Y_z).
#pragma once

#include <Eigen/Core>

#include "core/se3.hpp"

namespace plumb::vo {

using Matrix23d = Eigen::Matrix<double, 2, 3>;
using Matrix26d = Eigen::Matrix<double, 2, 6>;

/// Points nearer than this share of their host depth are treated as behind the camera.
inline constexpr double kMinDepthRatio = 0.02;

struct PointInFrame {
  Eigen::Vector3d Y = Eigen::Vector3d::Zero();
  Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();
  bool in_front = false;
};

/// @param f_px  focal lengths (fx, fy)
[[nodiscard]] inline PointInFrame transfer(const Se3& T_frame_host, const Eigen::Vector2d& host_xy,
                                           double rho, const Eigen::Vector2d& seen_xy,
                                           const Eigen::Vector2d& f_px) {
  PointInFrame p;
  p.Y = T_frame_host.R * host_xy.homogeneous() + rho * T_frame_host.t;
  p.in_front = p.Y.z() > kMinDepthRatio;
  if (p.in_front) p.residual_px = f_px.cwiseProduct(seen_xy - p.Y.head<2>() / p.Y.z());
  return p;
}

/// d(pixel) / dY, 2 x 3.
[[nodiscard]] inline Matrix23d projection_jacobian(const Eigen::Vector3d& Y,
                                                   const Eigen::Vector2d& f_px) {
  const double inv_z = 1.0 / Y.z();
  Matrix23d D;
  D << f_px.x() * inv_z, 0.0, -f_px.x() * Y.x() * inv_z * inv_z,  //
      0.0, f_px.y() * inv_z, -f_px.y() * Y.y() * inv_z * inv_z;
  return D;
}

/// d(pixel) / d(frame's pose) for T_frame_world <- (exp(w^), d) T_frame_world, columns (d, w).
[[nodiscard]] inline Matrix26d frame_jacobian(const Matrix23d& D, const Eigen::Vector3d& Y,
                                              double rho) {
  Matrix26d J;
  J.leftCols<3>() = rho * D;
  // -D hat(Y), written out: column k is D (e_k x Y).
  J.col(3) = D.col(2) * Y.y() - D.col(1) * Y.z();
  J.col(4) = D.col(0) * Y.z() - D.col(2) * Y.x();
  J.col(5) = D.col(1) * Y.x() - D.col(0) * Y.y();
  return J;
}

/// d(pixel) / d(host's pose), same perturbation of T_host_world.
[[nodiscard]] inline Matrix26d host_jacobian(const Matrix23d& D,
                                             const Eigen::Matrix3d& R_frame_host,
                                             const Eigen::Vector2d& host_xy, double rho) {
  const Matrix23d DR = D * R_frame_host;
  Matrix26d J;
  J.leftCols<3>() = -rho * DR;
  // DR hat(m) with m = (x, y, 1).
  J.col(3) = DR.col(1) - DR.col(2) * host_xy.y();
  J.col(4) = DR.col(2) * host_xy.x() - DR.col(0);
  J.col(5) = DR.col(0) * host_xy.y() - DR.col(1) * host_xy.x();
  return J;
}

/// Applies the perturbation (d, w) the Jacobians above are for.
inline void perturb(Se3& T_frame_world, const Vector6d& step) {
  const Eigen::Matrix3d E = exp_so3(step.tail<3>());
  T_frame_world.R = E * T_frame_world.R;
  T_frame_world.t = E * T_frame_world.t + step.head<3>();
  T_frame_world.normalize();
}

}  // namespace plumb::vo
