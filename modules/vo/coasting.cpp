/// Pipeline's steps for images that show nothing: the motion goes on as predicted, and fades.
#include <cmath>

#include "modules/vo/pipeline.hpp"

namespace plumb::vo {
namespace {

// 1-sigma of a predicted motion, as a share of it and per second unseen.
constexpr double kMotionStdRatio = 0.1;
constexpr double kAccelerationStd = 1.5;      // [vo]/s^2
constexpr double kTurnAccelerationStd = 0.2;  // rad/s^2

}  // namespace

void Pipeline::coast(const VoInput& input, VoReason reason) {
  out_.reason = reason;
  out_.status = VoStatus::kLost;
  if (mode_ == Mode::kEmpty) return;
  unseen_s_ += dt_s_;
  const bool predicts = motion_.known() && unseen_s_ <= config_.coast_limit_s;
  const Se3 T_prev_cam = predicts ? motion_.predict(dt_s_) : Se3{};
  motion_.decay(dt_s_, config_.coast_decay_s);
  predicted_distance_ += motion_.seen_speed() * dt_s_;
  held_ = false;
  window_.remember(input.seq, T_prev_cam.inverse() * last_pose(), false);
  if (predicts) report_prediction(T_prev_cam);
}

void Pipeline::report_prediction(const Se3& T_prev_cam) {
  out_.status = VoStatus::kCoasting;
  const double t_std = kMotionStdRatio * T_prev_cam.t.norm() + kAccelerationStd * unseen_s_ * dt_s_;
  const double w_std =
      kMotionStdRatio * log_so3(T_prev_cam.R).norm() + kTurnAccelerationStd * unseen_s_ * dt_s_;
  out_.cov_prev_cam.setZero();
  out_.cov_prev_cam.diagonal().head<3>().setConstant(t_std * t_std);
  out_.cov_prev_cam.diagonal().tail<3>().setConstant(w_std * w_std);
}

}  // namespace plumb::vo
