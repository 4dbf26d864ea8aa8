/// Filter of the road in VO's unit: state x = (n1, n3, ln h, b), n = (n1, sqrt(1 - n1^2 - n3^2), n3).
///
/// Two planes with one covariance. The one under the car, (n1, n3, ln h), which direction of travel and scale belong to:
/// its normal turns with the camera (the plane stays in the world, up to the road's curvature); ln h is a random walk
/// with VO's scale drift as its only noise, because a car's height over its road does not change. So metres per [vo] =
/// camera height / h. And the one ahead, (n1, n3 + b, ln h + slope b), which cameras see: the bend b comes and goes over
/// some way, more strongly the more this drive's road has bent lately.
///
/// Frames  cam: x right, y down, z forward; n points down.  Units  h in [vo], angles as sines.
#pragma once

#include <Eigen/Core>

#include "core/se3.hpp"
#include "modules/ground/filter/road_bend.hpp"

namespace plumb {

/// Parts of the measurement functions, for Jacobian tests as much as for the filter; x = (n1, n3, ln h) of either plane.
[[nodiscard]] Eigen::Vector3d normal_of_state(const Eigen::Vector3d& x);
/// d(n)/d(n1, n3).
[[nodiscard]] Eigen::Matrix<double, 3, 2> normal_jacobian(const Eigen::Vector3d& x);
/// d(q)/d(n1, n3, ln h) of q = n / h.
[[nodiscard]] Eigen::Matrix3d plane_jacobian(const Eigen::Vector3d& x);

class PlaneFilter {
 public:
  /// On flat roads, unless told otherwise.
  explicit PlaneFilter(const RoadBend& bend = {}) : bend_(bend) {}

  [[nodiscard]] bool started() const { return started_; }
  /// (n1, n3, ln h) under the car.
  [[nodiscard]] Eigen::Vector3d state() const { return x_.head<3>(); }
  [[nodiscard]] Eigen::Matrix3d cov() const { return P_.topLeftCorner<3, 3>(); }
  [[nodiscard]] Eigen::Vector3d normal() const { return normal_of_state(state()); }
  /// (n1, n3, ln h) of the road ahead.
  [[nodiscard]] Eigen::Vector3d ahead() const { return to_ahead_ * x_; }
  [[nodiscard]] Eigen::Matrix3d ahead_cov() const { return to_ahead_ * P_ * to_ahead_.transpose(); }
  /// Of g . (n1, n3, ln h) ahead minus ln h under the car.
  [[nodiscard]] double ahead_var(const Eigen::RowVector3d& g) const;

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
  /// n . direction = 0 under the car, with variance `var`.
  void observe_travel(const Eigen::Vector3d& direction, double var);
  /// n3 ahead with variance `var`. False when the gate refuses.
  bool observe_pitch(double n3, double var);
  /// The whole plane ahead at once. False when the gate refuses.
  bool observe_plane(const Eigen::Vector3d& state, const Eigen::Matrix3d& cov);
  /// ln(n . centre) = ln h ahead with variance `var`. False when the gate refuses.
  bool observe_point(const Eigen::Vector3d& centre, double var);

  /// Closes a frame: a run of frames in which every height was refused opens the gate again.
  void end_frame(bool any_used, bool any_refused);

 private:
  void predict_bend(double step_ratio);
  bool update_scalar(const Eigen::RowVector4d& H, double residual, double var, bool robust);

  RoadBend bend_;
  Eigen::Matrix<double, 3, 4> to_ahead_ = ahead_jacobian(bend_);
  bool started_ = false;
  int num_refused_frames_ = 0;
  double bend_var_ = 0.0;  ///< of this drive's road, as far as it has shown
  Eigen::Vector4d x_ = Eigen::Vector4d::Zero();
  Eigen::Matrix4d P_ = Eigen::Matrix4d::Zero();

  [[nodiscard]] static Eigen::Matrix<double, 3, 4> ahead_jacobian(const RoadBend& bend);
};

}  // namespace plumb
