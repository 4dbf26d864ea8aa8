/// Pose of one frame from tracked points whose inverse depths are uncertain.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/se3.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

/// Position noise of a tracked point, 1-sigma per axis, as used in all weights.
inline constexpr double kPixelStd = 0.5;
/// Squared normalised residual from which a point no longer agrees with the pose.
inline constexpr double kInlierChi2 = 9.0;

struct PoseFit {
  Se3 T_cam_world;
  Matrix6d information = Matrix6d::Zero();  ///< of the (d, w) perturbation of T_cam_world
  int num_points = 0;
  int num_inliers = 0;
  double rms_px = 0.0;  ///< of the inliers, less what their uncertain depths explain
  [[nodiscard]] double inlier_ratio() const {
    return num_points > 0 ? static_cast<double>(num_inliers) / num_points : 0.0;
  }
};

struct PoseOptions {
  int max_iterations = 8;
  double kernel_scale = 1.0;      ///< widens the Cauchy kernel, for poor starts
  bool hold_translation = false;  ///< solve the rotation about the start's camera centre only
};

/// Minimises sum rho_cauchy(r^T S^-1 r), S = sigma^2 I + d d^T rho_std^2 with d = dr/drho, over the active tracks.
/// @param focal_px  (fx, fy)
[[nodiscard]] PoseFit fit_pose(const Se3& start, const TrackTable& tracks, const Window& window,
                               const Eigen::Vector2d& focal_px, const PoseOptions& options);

/// Covariance of T_prev_cam, of (t, right-perturbation of R), for the motion from T_prev_world to the fitted pose.
/// It states more than the fit's information matrix promises, because the errors of tracks on one structure are not
/// independent.
[[nodiscard]] Matrix6d motion_covariance(const PoseFit& pose, const Se3& T_prev_world);

}  // namespace plumb::vo
