/// Poses, covariances and vectors <-> the plain arrays of messages.
///
/// The round trip R -> q -> R changes the last bits. Live processes and the replay both pass
/// through these functions, so that their results are equal.
///
/// Errors:
///   from_wire() returns null when the values are valid, and else the reason as a string literal.
///   The result is then unspecified.
#pragma once

#include <cmath>

#include "core/se3.hpp"

namespace plumb {

/// Writes a unit quaternion (w, x, y, z) with w >= 0, and the translation.
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

/// Reads a pose. The numbers must be finite and the quaternion of unit length.
[[nodiscard]] inline const char* from_wire(const double (&q_a_b)[4], const double (&t_a_b)[3],
                                           Se3* T_a_b) {
  constexpr double kUnitTolerance = 1e-6;
  const Eigen::Quaterniond q(q_a_b[0], q_a_b[1], q_a_b[2], q_a_b[3]);
  const Eigen::Vector3d t(t_a_b[0], t_a_b[1], t_a_b[2]);
  // The comparison is negated so that NaN fails it.
  if (!(std::abs(q.squaredNorm() - 1.0) <= kUnitTolerance)) return "a quaternion is not a unit one";
  if (!t.allFinite()) return "a translation is not finite";
  T_a_b->R = q.toRotationMatrix();
  T_a_b->t = t;
  return nullptr;
}

template <int kSize>
void to_wire(const Eigen::Matrix<double, kSize, kSize>& matrix, double (&out)[kSize][kSize]) {
  for (int row = 0; row < kSize; ++row)
    for (int col = 0; col < kSize; ++col) out[row][col] = matrix(row, col);
}

/// Reads a covariance. Its entries must be finite and its variances not negative.
template <int kSize>
[[nodiscard]] const char* from_wire(const double (&in)[kSize][kSize],
                                    Eigen::Matrix<double, kSize, kSize>* matrix) {
  for (int row = 0; row < kSize; ++row)
    for (int col = 0; col < kSize; ++col) (*matrix)(row, col) = in[row][col];
  if (!matrix->allFinite()) return "a covariance is not finite";
  return matrix->diagonal().minCoeff() >= 0.0 ? nullptr : "a variance is negative";
}

template <int kSize>
void to_wire(const Eigen::Matrix<double, kSize, 1>& vector, double (&out)[kSize]) {
  for (int i = 0; i < kSize; ++i) out[i] = vector[i];
}

}  // namespace plumb
