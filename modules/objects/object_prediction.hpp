/// Predicts the state of an object from one image to the next.
///
/// Frames:
///   ground as in track_view.hpp. A prediction moves the state into the axes of the new image.
/// Model:
///   Constant velocity with white acceleration. The heading and the error of the plane are
///   first-order Gauss-Markov processes; the logarithms of the sizes are random walks.
#pragma once

#include <Eigen/Core>

#include "modules/objects/box_fit.hpp"
#include "modules/objects/track_view.hpp"

namespace plumb {

/// Standard deviation [rad] of the heading about its mean, for the prior and for the process.
inline constexpr double kHeadingStd_rad = 0.25;
/// Standard deviation of the velocity of a stationary object.
inline constexpr double kStationarySpeedStd_m_s = 0.1;

/// The new ground axes relative to the old ones.
struct AxesStep {
  Eigen::Matrix2d R_new_old = Eigen::Matrix2d::Identity();
  Eigen::Vector2d t_m = Eigen::Vector2d::Zero();  ///< new origin in the old axes
  double yaw_rad = 0.0;
};

/// Wraps an angle to [-pi, pi].
[[nodiscard]] double wrapped(double angle_rad);

/// Variance [rad^2] of the pitch at which the foot of an object appears. It adds up the pitch of
/// the plane, the bend of the road, and the height of the road between the camera's lane and the
/// object, whose effect decreases with the distance.
[[nodiscard]] double plane_error_var(const TrackView& view, const Eigen::Vector2d& position_m);

/// Predicts the state over `dt_s` without the effect of acceleration. `heading_rad` is the mean to
/// which the heading reverts.
void predict_state(const TrackView& view, const AxesStep& axes, double dt_s, double heading_rad,
                   StateEstimate* estimate);

/// Adds the covariance of white acceleration over `dt_s`.
void add_acceleration(double accel_var, double dt_s, StateEstimate* estimate);

/// Sets the velocity to zero with a small variance and makes it independent of the other states.
void set_stationary(StateEstimate* estimate);

}  // namespace plumb
