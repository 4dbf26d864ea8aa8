/// Projection of a point with inverse depth into another frame, and its derivatives, which all
/// estimators of this module share.
///
/// A point with the ray m = (x, y, 1) and the inverse depth rho in its host frame is
///   Y = R m + rho t
/// in another frame, up to the factor rho. The residual is r = f (z - Y_xy / Y_z) for the observed
/// normalised coordinates z. The derivatives are those of the prediction, d(f Y_xy / Y_z), so that
/// a Gauss-Newton step solves J step = r. Source: Civera, Davison, Montiel, "Inverse Depth
/// Parametrization for Monocular SLAM", 2008.
///
/// Perturbation:
///   A step (d, w) changes a pose to T_frame_world <- (exp(w^), d) T_frame_world.
/// Units:
///   Residuals in pixels, rho in 1/[vo], d in [vo], w in radians.
#pragma once

#include <Eigen/Core>

#include "core/se3.hpp"

namespace plumb::vo {

using Matrix23d = Eigen::Matrix<double, 2, 3>;
using Matrix26d = Eigen::Matrix<double, 2, 6>;

/// A point whose depth is a smaller share of its depth in the host counts as behind the camera.
inline constexpr double kMinDepthRatio = 0.02;

/// Returns Y, the position in a frame divided by the depth in the host.
[[nodiscard]] inline Eigen::Vector3d transfer_point(const Se3& T_frame_host,
                                                    const Eigen::Vector2d& host_xy, double rho) {
  return T_frame_host.R * host_xy.homogeneous() + rho * T_frame_host.t;
}

struct PointInFrame {
  Eigen::Vector3d Y = Eigen::Vector3d::Zero();
  Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();
  bool in_front = false;  ///< the residual is valid
};

/// Returns a point in a frame and the residual of its observation there.
/// @param seen_xy  observed normalised coordinates
/// @param f_px     focal lengths (fx, fy)
[[nodiscard]] inline PointInFrame transfer(const Se3& T_frame_host, const Eigen::Vector2d& host_xy,
                                           double rho, const Eigen::Vector2d& seen_xy,
                                           const Eigen::Vector2d& f_px) {
  PointInFrame p;
  p.Y = transfer_point(T_frame_host, host_xy, rho);
  p.in_front = p.Y.z() > kMinDepthRatio;
  if (p.in_front) p.residual_px = f_px.cwiseProduct(seen_xy - p.Y.head<2>() / p.Y.z());
  return p;
}

/// Returns d(pixel) / dY.
[[nodiscard]] inline Matrix23d projection_jacobian(const Eigen::Vector3d& Y,
                                                   const Eigen::Vector2d& f_px) {
  const double inv_z = 1.0 / Y.z();
  Matrix23d D;
  D << f_px.x() * inv_z, 0.0, -f_px.x() * Y.x() * inv_z * inv_z,  //
      0.0, f_px.y() * inv_z, -f_px.y() * Y.y() * inv_z * inv_z;
  return D;
}

/// Returns d(pixel) / d(d, w) for a perturbation of the observing frame.
[[nodiscard]] inline Matrix26d frame_jacobian(const Matrix23d& D, const Eigen::Vector3d& Y,
                                              double rho) {
  Matrix26d J;
  J.leftCols<3>() = rho * D;
  // The last three columns are -D hat(Y); column k is D (e_k x Y).
  J.col(3) = D.col(2) * Y.y() - D.col(1) * Y.z();
  J.col(4) = D.col(0) * Y.z() - D.col(2) * Y.x();
  J.col(5) = D.col(1) * Y.x() - D.col(0) * Y.y();
  return J;
}

/// Returns d(pixel) / d(d, w) for a perturbation of the host.
[[nodiscard]] inline Matrix26d host_jacobian(const Matrix23d& D,
                                             const Eigen::Matrix3d& R_frame_host,
                                             const Eigen::Vector2d& host_xy, double rho) {
  const Matrix23d DR = D * R_frame_host;
  Matrix26d J;
  J.leftCols<3>() = -rho * DR;
  // The last three columns are DR hat(m) with m = (x, y, 1).
  J.col(3) = DR.col(1) - DR.col(2) * host_xy.y();
  J.col(4) = DR.col(2) * host_xy.x() - DR.col(0);
  J.col(5) = DR.col(0) * host_xy.y() - DR.col(1) * host_xy.x();
  return J;
}

/// Applies the perturbation (d, w) to a pose.
inline void perturb(Se3& T_frame_world, const Vector6d& step) {
  const Eigen::Matrix3d E = exp_so3(step.tail<3>());
  T_frame_world.R = E * T_frame_world.R;
  T_frame_world.t = E * T_frame_world.t + step.head<3>();
  T_frame_world.normalize();
}

}  // namespace plumb::vo
