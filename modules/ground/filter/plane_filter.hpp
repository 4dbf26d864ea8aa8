/// Extended Kalman filter of the road in VO's unit: x = (n1, n3, ln h, b, m).
///
/// The filter holds two planes with one covariance:
/// - the plane under the car, (n1, n3, ln h). The direction of translation and the scale refer to
///   it. Its normal turns with the camera, because the plane stays in the world up to the road's
///   curvature. ln h is a random walk whose only noise is the drift of VO's scale, because the
///   camera's height over the road is constant: metres per [vo] = camera height / h.
/// - the plane ahead, (n1, n3 + b, ln h + slope b), which the camera sees. The bend b is a
///   first-order Gauss-Markov process over the distance travelled, as strong as the road's bends
///   have lately been.
///
/// m is the error of the height that the road's speed gives (cues/motion_cue.hpp). It comes from
/// the pitch of the camera and changes slowly, over the distance travelled: the other cues tell it,
/// and while they see nothing, the road's speed follows the drift of VO's unit finely.
///
/// Robustness: innovations are taken as Student-t distributed. R grows by (nu + e^2) / (nu + 1)
/// with e^2 = y^T S^-1 y per degree of freedom, and an observation whose e^2 exceeds its gate is
/// rejected.
///
/// Frames:
///   cam: x right, y down, z forward; n = (n1, sqrt(1 - n1^2 - n3^2), n3) points down.
/// Units:
///   h in [vo], angles as sines.
#pragma once

#include <Eigen/Core>

#include "core/numbers.hpp"
#include "modules/ground/filter/observation.hpp"
#include "modules/ground/filter/road_bend.hpp"
#include "modules/ground/types/filter_config.hpp"
#include "modules/ground/types/plane_state.hpp"

namespace plumb {

/// What became of one observation.
struct FuseResult {
  bool accepted = false;
  /// Innovation before the update, its rows under (n1, n3, ln h); NaN where not observed.
  Eigen::Vector3d innovation = Eigen::Vector3d::Constant(kNan);
  /// e^2 over the gate; above 1 it was rejected. NaN for an observation without a gate.
  double test_ratio = kNan;
};

class PlaneFilter {
 public:
  /// The default is a filter of flat roads.
  explicit PlaneFilter(const RoadBend& bend = {}, const FilterConfig& config = {})
      : bend_(bend), config_(config) {}

  [[nodiscard]] bool started() const { return started_; }
  /// (n1, n3, ln h) under the car.
  [[nodiscard]] Eigen::Vector3d state() const { return x_.head<3>(); }
  [[nodiscard]] Eigen::Matrix3d cov() const { return P_.topLeftCorner<3, 3>(); }
  [[nodiscard]] Eigen::Vector3d normal() const { return normal_of_state(state()); }
  /// (n1, n3, ln h) of the road ahead.
  [[nodiscard]] Eigen::Vector3d ahead() const { return to_ahead_ * x_; }
  [[nodiscard]] Eigen::Matrix3d ahead_cov() const { return to_ahead_ * P_ * to_ahead_.transpose(); }
  /// Variance of g . (n1, n3, ln h) ahead minus ln h under the car.
  [[nodiscard]] double ahead_var(const Eigen::RowVector3d& g) const;

  [[nodiscard]] double height() const;
  [[nodiscard]] double ln_height_std() const;
  /// The height is known well enough to look for the road near it. False again after VO carried its
  /// unit over a long gap.
  [[nodiscard]] bool converged() const;

  /// Initialises the filter with a first estimate.
  void start(const Eigen::Vector3d& normal, double ln_height);
  /// Returns to the state before start().
  void reset() { started_ = false; }
  /// VO began a new unit. `ln_ratio_std` is the 1-sigma of ln(old unit / new unit); NaN when
  /// nothing is known of it, which resets the filter.
  void change_unit(double ln_ratio_std);
  /// The drift of VO's unit while no cue sees the road adds this variance.
  void add_height_var(double var) { P_(2, 2) += var; }
  /// Nothing is known any more of the error of the road's speed, and the height may be wrong by
  /// this variance in addition: what told them was refused.
  void doubt_height(double var);
  /// The camera's height over the road changed by this factor, at the same scale.
  void change_height(double ln_ratio);

  /// The camera moved by `R_prev_cam` and `step_ratio` camera heights.
  void predict(const Eigen::Matrix3d& R_prev_cam, double step_ratio);

  /// Updates the state with one observation. @pre started(), observation.function not null
  FuseResult fuse(const PlaneObservation& observation);

  /// The prior that cars do not lean much against their road.
  [[nodiscard]] PlaneObservation level_roll() const;

  /// Closes a frame: after a run of frames in which every height was rejected, the gate opens
  /// again.
  void end_frame(bool any_used, bool any_rejected);

 private:
  static constexpr int kSize = 5;
  using State = Eigen::Matrix<double, kSize, 1>;
  using Covariance = Eigen::Matrix<double, kSize, kSize>;
  using Row = Eigen::Matrix<double, 1, kSize>;
  using Jacobian = Eigen::Matrix<double, 3, kSize>;

  void predict_bend(double step_ratio);
  void know_speed_error(double var);
  void fade(int component, double keep, double var);
  FuseResult fuse_scalar(const Row& H, double innovation, const PlaneObservation& observation);
  FuseResult fuse_plane(const Jacobian& H, const Eigen::Vector3d& innovation,
                        const PlaneObservation& observation);
  [[nodiscard]] static Jacobian ahead_jacobian(const RoadBend& bend);

  RoadBend bend_;
  FilterConfig config_;
  Jacobian to_ahead_ = ahead_jacobian(bend_);
  bool started_ = false;
  int num_rejected_frames_ = 0;
  double bend_var_ = 0.0;         ///< of this drive's road, as far as it has shown
  double speed_error_var_ = 0.0;  ///< of the road's speed, as it was last stated
  State x_ = State::Zero();
  Covariance P_ = Covariance::Zero();
};

}  // namespace plumb
