/// Essential matrices from five correspondences.
///
/// The null space of the five epipolar equations, E = x E1 + y E2 + z E3 + E4, is put into
/// det E = 0 and 2 E E^T E - tr(E E^T) E = 0; the ten cubics are solved through the eigenvectors of the
/// multiplication-by-x matrix (Stewenius, Engels, Nister 2006).
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/fixed_vector.hpp"

namespace plumb::vo {

/// A point seen in two images, undistorted normalised coordinates.
struct RayPair {
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Vector2d second = Eigen::Vector2d::Zero();
};

using EssentialSolutions = FixedVector<Eigen::Matrix3d, 10>;

/// All real E with second^T E first = 0, unit Frobenius norm.
void solve_five_point(const std::array<RayPair, 5>& pairs, EssentialSolutions* solutions);

}  // namespace plumb::vo
