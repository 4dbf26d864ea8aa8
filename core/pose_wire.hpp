/// Poses and matrices <-> the plain arrays of messages.
///
/// R -> q -> R is not exact to the bit, so live processes and the replay both pass through these functions.
#pragma once

#include <cmath>

#include "core/se3.hpp"

namespace plumb {

/// Quaternion w, x, y, z with w >= 0, and translation.
inline void to_wire(const Se3& T_a_b, double (&q_a_b)[4], double (&t_a_b)[3]) {
  Eigen::Quaterniond q(T_a_b.R);
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  q_a_b[0] = q.w();
  q_a_b[1] = q.x();
  q_a_b[2] = q.y();
  q_a_b[3] = q.z();
  for (int i = 0; i < 3; ++i) t_a_b[i] = T_a_b.t[i];
}

/// False when a number is not finite or the quaternion is not of unit length.
[[nodiscard]] inline bool from_wire(const double (&q_a_b)[4], const double (&t_a_b)[3],
                                    Se3* T_a_b) {
  constexpr double kUnitTolerance = 1e-6;
  const Eigen::Quaterniond q(q_a_b[0], q_a_b[1], q_a_b[2], q_a_b[3]);
  const Eigen::Vector3d t(t_a_b[0], t_a_b[1], t_a_b[2]);
  // Written so that NaN fails.
  if (!(std::abs(q.squaredNorm() - 1.0) <= kUnitTolerance) || !t.allFinite()) return false;
  T_a_b->R = q.toRotationMatrix();
  T_a_b->t = t;
  return true;
}

template <int kSize>
void to_wire(const Eigen::Matrix<double, kSize, kSize>& matrix, double (&out)[kSize][kSize]) {
  for (int row = 0; row < kSize; ++row)
    for (int col = 0; col < kSize; ++col) out[row][col] = matrix(row, col);
}

/// False when an entry is not finite or a variance is negative.
template <int kSize>
[[nodiscard]] bool from_wire(const double (&in)[kSize][kSize],
                             Eigen::Matrix<double, kSize, kSize>* matrix) {
  for (int row = 0; row < kSize; ++row)
    for (int col = 0; col < kSize; ++col) (*matrix)(row, col) = in[row][col];
  return matrix->allFinite() && matrix->diagonal().minCoeff() >= 0.0;
}

template <int kSize>
void to_wire(const Eigen::Matrix<double, kSize, 1>& vector, double (&out)[kSize]) {
  for (int i = 0; i < kSize; ++i) out[i] = vector[i];
}

}  // namespace plumb
