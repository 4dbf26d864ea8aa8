#include "modules/vo/motion_predictor.hpp"

#include <cmath>

namespace plumb::vo {
namespace {

// Standard deviation of a predicted motion: a share of the motion, and what an unknown acceleration
// adds over the time without a measurement.
constexpr double kMotionStdRatio = 0.1;
constexpr double kAccelerationStd = 1.5;      // [vo]/s^2
constexpr double kTurnAccelerationStd = 0.2;  // rad/s^2

}  // namespace

MotionPredictor::MotionPredictor(const VoConfig& config)
    : MotionPredictor(config.coast_limit_s, config.coast_decay_s) {}

void MotionPredictor::observe(const Se3& T_prev_cam, double dt_s) {
  velocity_ = T_prev_cam.t / dt_s;
  rate_ = log_so3(T_prev_cam.R) / dt_s;
  measured_speed_ = velocity_.norm();
  known_ = true;
  unseen_s_ = 0.0;
}

Se3 MotionPredictor::predict(double dt_s) const {
  if (!known_) return {};
  return {exp_so3(rate_ * dt_s), velocity_ * dt_s};
}

/// A constant acceleration a leaves the straight line by a before after / 2.
Matrix6d MotionPredictor::interpolation_cov(double before_s, double after_s) {
  const double t_std = 0.5 * kAccelerationStd * before_s * after_s;
  const double w_std = 0.5 * kTurnAccelerationStd * before_s * after_s;
  Matrix6d cov = Matrix6d::Zero();
  cov.diagonal().head<3>().setConstant(t_std * t_std);
  cov.diagonal().tail<3>().setConstant(w_std * w_std);
  return cov;
}

PredictedMotion MotionPredictor::extrapolate(double dt_s) {
  unseen_s_ += dt_s;
  PredictedMotion motion;
  motion.valid = known_ && unseen_s_ <= coast_limit_s_;
  if (!motion.valid) return motion;
  motion.T_prev_cam = predict(dt_s);
  const double t_std =
      kMotionStdRatio * motion.T_prev_cam.t.norm() + kAccelerationStd * unseen_s_ * dt_s;
  const double w_std = kMotionStdRatio * log_so3(motion.T_prev_cam.R).norm() +
                       kTurnAccelerationStd * unseen_s_ * dt_s;
  motion.cov.diagonal().head<3>().setConstant(t_std * t_std);
  motion.cov.diagonal().tail<3>().setConstant(w_std * w_std);
  return motion;
}

PredictedMotion MotionPredictor::coast(double dt_s) {
  const PredictedMotion motion = extrapolate(dt_s);
  const double keep = std::exp(-dt_s / coast_decay_s_);
  velocity_ *= keep;
  rate_ *= keep * keep;  // a turn ends sooner than a drive
  return motion;
}

}  // namespace plumb::vo
