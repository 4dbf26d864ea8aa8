/// Filter of the road plane in VO's unit: state x = (n1, n3, ln h), n = (n1, sqrt(1 - n1^2 - n3^2),
/// n3).
///
/// Two filters with one covariance: the normal turns with the camera (the plane stays in the world,
/// up to the road's curvature); ln h is a random walk with VO's scale drift as its only noise,
/// because a car's height over its road does not change. So metres per [vo] = camera height / h.
///
/// Frames  cam: x right, y down, z forward; n points down.  Units  h in [vo], angles as sines.
#pragma once

#include <Eigen/Core>

#include "modules/geometry/se3.hpp"

namespace plumb {

/// Parts of the measurement functions, for Jacobian tests as much as for the filter.
[[nodiscard]] Eigen::Vector3d normal_of_state(const Eigen::Vector3d& x);
/// d(n)/d(n1, n3).
[[nodiscard]] Eigen::Matrix<double, 3, 2> normal_jacobian(const Eigen::Vector3d& x);
/// d(q)/d(n1, n3, ln h) of q = n / h.
[[nodiscard]] Eigen::Matrix3d plane_jacobian(const Eigen::Vector3d& x);

class PlaneFilter {
 public:
  [[nodiscard]] bool started() const { return started_; }
  [[nodiscard]] const Eigen::Vector3d& state() const { return x_; }
  [[nodiscard]] const Eigen::Matrix3d& cov() const { return P_; }
  [[nodiscard]] Eigen::Vector3d normal() const { return normal_of_state(x_); }
  [[nodiscard]] double height() const;
  [[nodiscard]] double ln_height_std() const;
  /// The height is known well enough to look for the road near it; false after VO carried its unit over a long gap.
  [[nodiscard]] bool sure() const;

  /// First estimate.
  void start(const Eigen::Vector3d& normal, double ln_height);
  /// Back to before the start.
  void forget() { started_ = false; }
  /// VO began a new unit: `ln_ratio_std` is what is known of old against new; NaN: nothing.
  void change_unit(double ln_ratio_std);

  /// The camera moved by `R_prev_cam` and `step_ratio` camera heights.
  void predict(const Eigen::Matrix3d& R_prev_cam, double step_ratio);

  void observe_level_roll();
  /// n . direction = 0 with variance `var`.
  void observe_travel(const Eigen::Vector3d& direction, double var);
  /// n3 with variance `var`. False when the gate refuses.
  bool observe_pitch(double n3, double var);
  /// The whole state at once. False when the gate refuses.
  bool observe_plane(const Eigen::Vector3d& state, const Eigen::Matrix3d& cov);
  /// ln(n . centre) = ln h with variance `var`. False when the gate refuses.
  bool observe_point(const Eigen::Vector3d& centre, double var);

  /// Closes a frame: a run of frames in which every height was refused opens the gate again.
  void end_frame(bool any_used, bool any_refused);

 private:
  bool update_scalar(const Eigen::RowVector3d& H, double residual, double var, bool robust);

  bool started_ = false;
  int num_refused_frames_ = 0;
  Eigen::Vector3d x_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d P_ = Eigen::Matrix3d::Zero();
};

}  // namespace plumb
