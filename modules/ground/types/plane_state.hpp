/// The road plane as the filter has it, x = (n1, n3, ln h), and its derivatives.
///
/// The unit normal n = (n1, n2, n3) points down, n . X = h, and n2 = sqrt(1 - n1^2 - n3^2).
///
/// Frames:
///   cam: x right, y down, z forward.
/// Units:
///   h in [vo]; q = n / h in 1/[vo].
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace plumb {

[[nodiscard]] inline Eigen::Vector3d normal_of_state(const Eigen::Vector3d& x) {
  return {x(0), std::sqrt(std::max(0.1, 1.0 - x(0) * x(0) - x(1) * x(1))), x(1)};
}

/// d(n) / d(n1, n3).
[[nodiscard]] inline Eigen::Matrix<double, 3, 2> normal_jacobian(const Eigen::Vector3d& x) {
  const double n2 = normal_of_state(x).y();
  Eigen::Matrix<double, 3, 2> J;
  J << 1.0, 0.0, -x(0) / n2, -x(1) / n2, 0.0, 1.0;
  return J;
}

/// d(q) / d(n1, n3, ln h) of q = n / h.
[[nodiscard]] inline Eigen::Matrix3d plane_jacobian(const Eigen::Vector3d& x) {
  const double inverse_height = std::exp(-x(2));
  Eigen::Matrix3d J;
  J.leftCols<2>() = normal_jacobian(x);
  J.col(2) = -normal_of_state(x);
  return inverse_height * J;
}

/// (n1, n3, ln h) of a plane q = n / h.
[[nodiscard]] inline Eigen::Vector3d state_of_plane(const Eigen::Vector3d& q) {
  const double norm = q.norm();
  return {q.x() / norm, q.z() / norm, -std::log(norm)};
}

}  // namespace plumb
