/// Relative pose of two images from point pairs.
///
/// RANSAC with five points (five_point.hpp) and the truncated quadratic score of MSAC (Torr &
/// Zisserman 2000) finds an essential matrix. Of its four decompositions, the one with most points
/// before both cameras is refined by Gauss-Newton on the Sampson error with Cauchy weights.
///
/// Frames:
///   T_second_first maps coordinates in the first camera to coordinates in the second one.
/// Units:
///   Point pairs in undistorted normalised coordinates; lengths relative to the distance of the
///   cameras.
/// Errors:
///   TwoView::ok is false when there are fewer than 20 pairs or inliers.
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

/// Solves for the relative pose.
/// @param focal_px  converts normalised coordinates to pixels
/// @param guess     predicted pose, which is the first hypothesis unless its t is zero
/// @param random    generator of the samples
[[nodiscard]] TwoView solve_two_view(const std::vector<RayPair>& pairs, double focal_px,
                                     const Se3& guess, Random& random);

/// The rotation that explains the pairs best without a translation.
struct RotationFit {
  Eigen::Matrix3d R_second_first = Eigen::Matrix3d::Identity();
  double median_px = 0.0;  ///< median residual
};
/// Fits a rotation to the pairs by Gauss-Newton with Cauchy weights.
/// @param scratch  holds the residuals; its capacity must be at least pairs.size()
[[nodiscard]] RotationFit fit_rotation(const std::vector<RayPair>& pairs, double focal_px,
                                       std::vector<double>& scratch);

/// Computes the inverse depth in the first camera, in units of 1/|t|. Returns false when the rays
/// do not intersect before both cameras.
[[nodiscard]] bool triangulate(const RayPair& pair, const Se3& T_second_first, double* rho);

}  // namespace plumb::vo
