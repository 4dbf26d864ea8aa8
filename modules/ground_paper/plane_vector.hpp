/// The observation vector of the paper, z = (n1, n3, h), and its plane.
///
/// Frames:
///   cam: n = (n1, n2, n3) points down, with n . X = h and n2 = sqrt(1 - n1^2 - n3^2).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace plumb {

enum PlaneComponent : int { kN1 = 0, kN3 = 1, kH = 2 };

[[nodiscard]] inline Eigen::Vector3d normal_of(const Eigen::Vector3d& z) {
  return {z(kN1), std::sqrt(std::max(0.0, 1.0 - z(kN1) * z(kN1) - z(kN3) * z(kN3))), z(kN3)};
}

/// Returns n / h.
[[nodiscard]] inline Eigen::Vector3d q_of(const Eigen::Vector3d& z) { return normal_of(z) / z(kH); }

}  // namespace plumb
