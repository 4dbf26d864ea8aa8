/// Relative pose of two images from point pairs: seeded RANSAC over five points, then robust refinement.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/se3.hpp"
#include "modules/vo/five_point.hpp"
#include "modules/vo/random.hpp"

namespace plumb::vo {

struct TwoView {
  Se3 T_second_first;  ///< |t| = 1
  int num_inliers = 0;
  bool ok = false;
};

/// @param focal_px   turns normalised errors into pixels
/// @param guess      tried first, e.g. from a motion model; its t may be zero (then only RANSAC speaks)
[[nodiscard]] TwoView solve_two_view(const std::vector<RayPair>& pairs, double focal_px,
                                     const Se3& guess, Random& random);

/// Rotation that explains the pairs best when nothing translates.
struct RotationFit {
  Eigen::Matrix3d R_second_first = Eigen::Matrix3d::Identity();
  double median_px = 0.0;  ///< what it leaves unexplained
};
[[nodiscard]] RotationFit fit_rotation(const std::vector<RayPair>& pairs, double focal_px,
                                       std::vector<double>& scratch);

/// Inverse depth in the first image, 1/|t| units. False when the rays do not meet in front of both cameras.
[[nodiscard]] bool triangulate(const RayPair& pair, const Se3& T_second_first, double* rho);

}  // namespace plumb::vo
