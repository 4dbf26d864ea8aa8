/// Predicts the camera's motion: constant velocity between images, fading while nothing is seen.
///
/// Frames   cam, before and after the motion: T_prev_cam maps cam now to cam of the previous image.
/// Units    [vo]/s and rad/s; seconds.
#pragma once

#include "core/se3.hpp"
#include "modules/vo/vo_config.hpp"

namespace plumb::vo {

/// A motion that was not seen, with what is known of it.
struct PredictedMotion {
  bool valid = false;               ///< false when no motion was ever measured, or too long ago
  Se3 T_prev_cam;                   ///< the identity unless valid
  Matrix6d cov = Matrix6d::Zero();  ///< of (t, right-perturbation of R); valid only
};

class MotionPredictor {
 public:
  explicit MotionPredictor(const VoConfig& config);

  /// Takes a measured motion over `dt_s`. @pre dt_s > 0
  void observe(const Se3& T_prev_cam, double dt_s);
  /// An image was understood, although it gave no motion to observe.
  void mark_seen() { unseen_s_ = 0.0; }

  /// Whether a motion was ever measured.
  [[nodiscard]] bool known() const { return known_; }
  /// Motion over `dt_s` at constant velocity; the identity when none is known.
  [[nodiscard]] Se3 predict(double dt_s) const;
  /// Speed when it was last measured, however long ago [vo]/s; 0 when none is known.
  [[nodiscard]] double measured_speed() const { return known_ ? measured_speed_ : 0.0; }
  /// Time since a motion was measured.
  [[nodiscard]] double unseen_s() const { return unseen_s_; }

  /// Carries the motion over an image `dt_s` later that did not show it.
  [[nodiscard]] PredictedMotion extrapolate(double dt_s);
  /// The same, for an image that shows nothing at all: the motion fades from image to image.
  [[nodiscard]] PredictedMotion coast(double dt_s);

 private:
  double coast_limit_s_;
  double coast_decay_s_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();
  double measured_speed_ = 0.0;
  double unseen_s_ = 0.0;
  bool known_ = false;
};

}  // namespace plumb::vo
