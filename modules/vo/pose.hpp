/// Pose of one frame from tracked points whose inverse depths are uncertain.
///
/// fit_pose() minimises, over T_cam_world,
///   sum C(r^T S^-1 r),  S = sigma^2 I + d d^T rho_std^2,  d = dr/drho,
/// by iteratively reweighted Gauss-Newton. r is the residual of a point in pixels, sigma is
/// kPixelStd, and C is the Cauchy kernel C(s) = c^2 ln(1 + s / c^2).
///
/// Frames:
///   world: cam of the first image.
/// Units:
///   [vo], radians, pixels.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/se3.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

/// Standard deviation of a tracked point's position, per axis. All weights use it.
inline constexpr double kPixelStd = 0.5;
/// Gate on r^T S^-1 r, below which a point is an inlier.
inline constexpr double kInlierChi2 = 9.0;

struct PoseFit {
  Se3 T_cam_world;
  Matrix6d information = Matrix6d::Zero();  ///< of the perturbation (d, w), see projection.hpp
  int num_points = 0;                       ///< number of points before the camera
  int num_inliers = 0;
  double rms_px = 0.0;  ///< of the inliers' residuals, without the part that is due to their depths
  [[nodiscard]] double inlier_ratio() const {
    return num_points > 0 ? static_cast<double>(num_inliers) / num_points : 0.0;
  }
};

struct PoseOptions {
  int max_iterations = 8;
  double kernel_scale = 1.0;   ///< factor on c^2, larger than 1 for a poor start
  bool rotation_only = false;  ///< fit the rotation about the camera centre of the start
};

/// Fits the pose of the newest image to the active tracks.
/// @param focal_px  (fx, fy)
[[nodiscard]] PoseFit fit_pose(const Se3& start, const TrackTable& tracks, const Window& window,
                               const Eigen::Vector2d& focal_px, const PoseOptions& options);

/// Returns the covariance of T_prev_cam, of (t, right perturbation of R), for the motion from the
/// frame at T_prev_world to the fitted one. It is larger than the inverse of the fit's information
/// matrix, because the errors of tracks on the same structure are correlated.
[[nodiscard]] Matrix6d motion_covariance(const PoseFit& pose, const Se3& T_prev_world);

}  // namespace plumb::vo
