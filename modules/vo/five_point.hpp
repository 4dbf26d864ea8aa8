/// Essential matrices from five point pairs (Nister, "An Efficient Solution to the Five-Point
/// Relative Pose Problem", 2004), solved by a Groebner basis (Stewenius, Engels & Nister, "Recent
/// Developments on Direct Relative Orientation", 2006).
///
/// The five epipolar equations leave E = x E1 + y E2 + z E3 + E4. The constraints det E = 0 and
/// 2 E E^T E - tr(E E^T) E = 0 are ten cubic equations in (x, y, z). Their solutions are the
/// eigenvectors of the matrix that multiplies by x.
///
/// Frames:
///   Undistorted normalised coordinates (X/Z, Y/Z) of two cameras.
/// Memory:
///   Fixed-size matrices. Nothing is allocated.
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/fixed_vector.hpp"

namespace plumb::vo {

/// A point that two images see, in undistorted normalised coordinates.
struct RayPair {
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Vector2d second = Eigen::Vector2d::Zero();
};

using EssentialSolutions = FixedVector<Eigen::Matrix3d, 10>;

/// Finds all real E with second^T E first = 0 for the five pairs, up to ten, each with a Frobenius
/// norm of 1. There are none for degenerate pairs.
void solve_five_point(const std::array<RayPair, 5>& pairs, EssentialSolutions* solutions);

}  // namespace plumb::vo
