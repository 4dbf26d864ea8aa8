/// Constant velocity, with decay while nothing is seen.
///
/// Units  [vo]/s and rad/s, in the camera's own frame.
#pragma once

#include "core/se3.hpp"

namespace plumb::vo {

class MotionModel {
 public:
  void forget() { known_ = false; }
  [[nodiscard]] bool known() const { return known_; }

  /// @pre dt_s > 0
  void observe(const Se3& T_prev_cam, double dt_s) {
    velocity_ = T_prev_cam.t / dt_s;
    rate_ = log_so3(T_prev_cam.R) / dt_s;
    seen_speed_ = velocity_.norm();
    known_ = true;
  }
  void stop() {
    velocity_.setZero();
    rate_.setZero();
    seen_speed_ = 0.0;
    known_ = true;
  }
  /// Less and less motion, while it is only predicted.
  void decay(double dt_s, double time_constant_s) {
    const double keep = std::exp(-dt_s / time_constant_s);
    velocity_ *= keep;
    rate_ *= keep * keep;  // turns end sooner than drives
  }

  /// T_prev_cam after `dt_s`; the identity when nothing is known.
  [[nodiscard]] Se3 predict(double dt_s) const {
    if (!known_) return {};
    return {exp_so3(rate_ * dt_s), velocity_ * dt_s};
  }
  /// When it was last measured, however long ago: the best guess while nothing is seen.
  [[nodiscard]] double seen_speed() const { return known_ ? seen_speed_ : 0.0; }

 private:
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();
  double seen_speed_ = 0.0;
  bool known_ = false;
};

}  // namespace plumb::vo
