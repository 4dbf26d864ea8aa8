/// Predicts the camera's motion with a model of constant velocity. While images show nothing, the
/// motion is carried on for a limited time (coasting) and fades.
///
/// Frames:
///   T_prev_cam maps coordinates in cam after the motion to coordinates in cam before it.
/// Units:
///   [vo]/s, rad/s, seconds.
/// Errors:
///   PredictedMotion::valid is false when no motion was ever measured, or none for
///   vo.coast_limit_s.
#pragma once

#include "core/se3.hpp"
#include "modules/vo/vo_config.hpp"

namespace plumb::vo {

/// A motion that was predicted instead of measured.
struct PredictedMotion {
  bool valid = false;
  Se3 T_prev_cam;                   ///< the identity unless valid
  Matrix6d cov = Matrix6d::Zero();  ///< of (t, right perturbation of R); zero unless valid
};

class MotionPredictor {
 public:
  explicit MotionPredictor(const VoConfig& config);

  /// Takes the motion that was measured over `dt_s`. @pre dt_s > 0
  void observe(const Se3& T_prev_cam, double dt_s);
  /// Ends coasting although no motion was measured: the image was localised.
  void mark_seen() { unseen_s_ = 0.0; }

  /// Drops what was measured.
  void forget() { *this = MotionPredictor(coast_limit_s_, coast_decay_s_); }

  /// Returns whether a motion was measured.
  [[nodiscard]] bool known() const { return known_; }
  /// Returns the motion over `dt_s` at constant velocity, or the identity unless known().
  [[nodiscard]] Se3 predict(double dt_s) const;
  /// Returns the last measured speed [vo]/s, however old it is, or 0 unless known().
  [[nodiscard]] double measured_speed() const { return known_ ? measured_speed_ : 0.0; }
  /// Returns the time since a motion was measured.
  [[nodiscard]] double unseen_s() const { return unseen_s_; }

  /// Returns the covariance of a pose in the middle of a measured motion, `before_s` after its
  /// start and `after_s` before its end, that was interpolated at constant velocity.
  [[nodiscard]] static Matrix6d interpolation_cov(double before_s, double after_s);
  /// Predicts the motion to an image that comes `dt_s` later and could not be localised.
  [[nodiscard]] PredictedMotion extrapolate(double dt_s);
  /// Predicts the motion to an image that shows nothing. Later predictions are smaller: the motion
  /// fades with the time constant vo.coast_decay_s.
  [[nodiscard]] PredictedMotion coast(double dt_s);

 private:
  MotionPredictor(double coast_limit_s, double coast_decay_s)
      : coast_limit_s_(coast_limit_s), coast_decay_s_(coast_decay_s) {}

  double coast_limit_s_;
  double coast_decay_s_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // [vo]/s
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();      // rad/s
  double measured_speed_ = 0.0;
  double unseen_s_ = 0.0;
  bool known_ = false;
};

}  // namespace plumb::vo
