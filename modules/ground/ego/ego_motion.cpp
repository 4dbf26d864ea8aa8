#include "modules/ground/ego/ego_motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "modules/ground/filter/plane_angles.hpp"

namespace plumb {
namespace {
bool turns(VoStatus status) {
  return status == VoStatus::kOk || status == VoStatus::kStandstill ||
         status == VoStatus::kRotationOnly || status == VoStatus::kCoasting;
}

bool needs_scale(VoStatus status) {
  return status == VoStatus::kOk || status == VoStatus::kCoasting;
}

EgoStatus status_of(const VoOutput& vo, const ScaleEstimate& scale) {
  switch (vo.status) {
    case VoStatus::kLost:
      return EgoStatus::kLost;
    case VoStatus::kInitializing:
      return EgoStatus::kInitializing;
    case VoStatus::kStandstill:
      return EgoStatus::kStandstill;
    case VoStatus::kCoasting:
      return scale.known ? EgoStatus::kCoasting : EgoStatus::kInitializing;
    case VoStatus::kOk:
    case VoStatus::kRotationOnly:
      break;
  }
  if (!scale.known) return EgoStatus::kInitializing;
  return scale.measured_now ? EgoStatus::kOk : EgoStatus::kScaleHeld;
}

}  // namespace

void EgoMotion::update(const VoOutput& vo, const ScaleEstimate& scale,
                       const Eigen::Vector3d& normal_cam, EgoOutput* out) {
  *out = EgoOutput{};
  out->status = status_of(vo, scale);
  out->reason = vo.reason;
  if (scale.known) {
    out->log_scale = scale.log_scale;
    out->log_scale_std = std::sqrt(scale.var);
  }

  const bool moved = turns(vo.status) && vo.prev_seq >= 0;
  const bool metric = moved && (scale.known || !needs_scale(vo.status));
  follow_anchor(vo, moved);
  if (metric) {
    const double metres_per_vo = scale.known ? std::exp(scale.log_scale) : 0.0;
    out->T_prev_cam = {vo.T_prev_cam.R, metres_per_vo * vo.T_prev_cam.t};
    out->cov_prev_cam = motion_cov(vo, metres_per_vo);
    add_coasting(vo, out->T_prev_cam.t.norm(), &out->cov_prev_cam);
    integrate(vo, scale, *out);
    write_rates(vo, scale, normal_cam, out);
  } else {
    speed_.reset();
  }
  last_seq_ = vo.seq;
  out->T_world_cam = T_world_anchor_;
  out->cov_world_cam = cov_world_anchor_;
  out->distance_m = distance_m_;
  out->reset_counter = reset_counter_;
}

/// Covariance of (t, right-perturbation of R) in metres, without the error of the scale.
Matrix6d EgoMotion::motion_cov(const VoOutput& vo, double metres_per_vo) const {
  Matrix6d cov = vo.cov_prev_cam;
  cov.topRows<3>() *= metres_per_vo;
  cov.leftCols<3>() *= metres_per_vo;
  if (vo.status == VoStatus::kStandstill) {
    cov.setZero();
    cov.diagonal().head<3>().setConstant(square(config_.standstill_step_std_m));
    cov.diagonal().tail<3>().setConstant(square(config_.standstill_turn_std_rad));
  }
  return cov;
}

/// Adds what the driver may have done while the motion was predicted. The first measured step after
/// that corrects a predicted pose, and so has the error of all predicted steps.
void EgoMotion::add_coasting(const VoOutput& vo, double step_m, Matrix6d* cov) {
  if (vo.status != VoStatus::kCoasting) {
    *cov += cov_coasted_;
    cov_coasted_.setZero();
    num_coasted_ = 0;
    return;
  }
  ++num_coasted_;
  const double step = num_coasted_ * config_.coast_step_ratio * step_m;
  const double turn = num_coasted_ * config_.coast_turn_std_rad;
  Matrix6d added = Matrix6d::Zero();
  added.diagonal().head<3>().setConstant(step * step);
  added.diagonal().tail<3>().setConstant(turn * turn);
  *cov += added;
  cov_coasted_ += added;
}

/// Updates T_anchor_cam, or finds that the path from the anchor is lost.
void EgoMotion::follow_anchor(const VoOutput& vo, bool moved) {
  if (!anchored_ || vo.prev_seq < 0) {
    // How the camera moved to the first image of another time line is not known.
    if (anchored_) ++reset_counter_;
    anchored_ = true;
    anchor_seq_ = vo.seq;
    T_anchor_cam_ = Se3{};
    path_known_ = true;
    return;
  }
  for (const WindowPose& pose : vo.window) {
    if (pose.seq != anchor_seq_ || !moved) continue;
    T_anchor_cam_ = pose.T_window_cam;
    path_known_ = true;
    return;
  }
  // The window will reach back when VO has initialised.
  if (vo.status == VoStatus::kInitializing) return;
  if (moved && vo.prev_seq == last_seq_ && path_known_) {
    T_anchor_cam_ = T_anchor_cam_ * vo.T_prev_cam;
    return;
  }
  if (path_known_) ++reset_counter_;
  path_known_ = false;
  if (!moved) return;
  // Start again from the last known pose, at the previous image.
  T_anchor_cam_ = vo.T_prev_cam;
  path_known_ = true;
}

void EgoMotion::integrate(const VoOutput& vo, const ScaleEstimate& scale, const EgoOutput& out) {
  if (!path_known_) return;
  const double metres_per_vo = scale.known ? std::exp(scale.log_scale) : 0.0;
  const Se3 T_step{T_anchor_cam_.R, metres_per_vo * T_anchor_cam_.t};
  const Eigen::Matrix3d& R_world_anchor = T_world_anchor_.R;
  const Eigen::Vector3d moved = R_world_anchor * T_step.t;

  Matrix6d F = Matrix6d::Identity();
  F.topRightCorner<3, 3>() = -R_world_anchor * hat(T_step.t);
  F.bottomRightCorner<3, 3>() = T_step.R.transpose();
  Matrix6d G = Matrix6d::Identity();
  G.topLeftCorner<3, 3>() = R_world_anchor;
  const double num_frames = static_cast<double>(std::max<std::int64_t>(1, vo.seq - anchor_seq_));
  cov_world_anchor_ =
      F * cov_world_anchor_ * F.transpose() + num_frames * (G * out.cov_prev_cam * G.transpose());
  // d(position) = moved * d(log_scale), correlated with what the same error did to earlier steps.
  cov_position_scale_ *= scale.kept_ratio;
  cov_world_anchor_.topLeftCorner<3, 3>() += scale.var * moved * moved.transpose() +
                                             cov_position_scale_ * moved.transpose() +
                                             moved * cov_position_scale_.transpose();
  cov_position_scale_ += scale.var * moved;

  T_world_anchor_ = T_world_anchor_ * T_step;
  T_world_anchor_.normalize();
  distance_m_ += T_step.t.norm();
  anchor_seq_ = vo.seq;
  T_anchor_cam_ = Se3{};
}

/// Writes speeds and rates, and completes the covariance of the motion by the errors of scale and
/// speed.
void EgoMotion::write_rates(const VoOutput& vo, const ScaleEstimate& scale,
                            const Eigen::Vector3d& normal_cam, EgoOutput* out) {
  const Eigen::Vector3d& t = out->T_prev_cam.t;
  const Eigen::Matrix3d scale_cov = scale.var * t * t.transpose();
  const double dt_s = vo.interval_s;
  if (!(dt_s > 0.0)) {
    speed_.reset();
    out->cov_prev_cam.topLeftCorner<3, 3>() += scale_cov;
    return;
  }
  const Eigen::Matrix3d R_ground_cam = rotation_ground_cam(normal_cam);
  const Eigen::Matrix3d R_ground_prev = R_ground_cam * out->T_prev_cam.R.transpose();
  out->velocity_ground_m_s = R_ground_prev * t / dt_s;
  out->rate_ground_rad_s = R_ground_cam * log_so3(out->T_prev_cam.R) / dt_s;

  const Eigen::RowVector3d forward = R_ground_prev.row(0);
  const Eigen::RowVector3d up = R_ground_cam.row(2);
  auto step_cov = out->cov_prev_cam.topLeftCorner<3, 3>();
  const auto turn_cov = out->cov_prev_cam.bottomRightCorner<3, 3>();
  const double vo_var = forward * step_cov * forward.transpose();
  const double factor = scatter_factor(vo, out->velocity_ground_m_s.x(), vo_var / square(dt_s));
  out->cov_prev_cam.topRows<3>() *= std::sqrt(factor);
  out->cov_prev_cam.leftCols<3>() *= std::sqrt(factor);
  step_cov += scale_cov;
  // A wrong interval changes speed and rates, not the motion itself.
  const double dt_var_ratio = square(vo.interval_std_s / dt_s);
  const double step_var =
      forward * step_cov * forward.transpose() + dt_var_ratio * square(forward * t);
  const double turn = dt_s * out->rate_ground_rad_s.z();
  const double turn_var = up * turn_cov * up.transpose() + dt_var_ratio * square(turn);
  out->speed_std_m_s = std::sqrt(step_var) / dt_s;
  out->yaw_rate_std_rad_s = std::sqrt(turn_var) / dt_s;
  if (vo.status == VoStatus::kCoasting || !speed_.observable()) return;
  out->accel_forward_m_s2 = speed_.accel_m_s2();
  out->accel_forward_std_m_s2 = speed_.accel_std_m_s2();
}

/// Takes a speed and the variance that VO states. Returns the factor on that variance.
double EgoMotion::scatter_factor(const VoOutput& vo, double speed_m_s, double speed_var) {
  if (vo.status == VoStatus::kCoasting) return 1.0;
  const double dt_s = vo.interval_s;
  const double jitter_var = square(speed_m_s * vo.interval_std_s / dt_s);
  const double scatter =
      config_.least_speed_std_m_s + config_.step_scatter_ratio * std::abs(speed_m_s);
  speed_.update(speed_m_s, scatter * scatter + jitter_var, dt_s);
  const bool expected = !std::isnan(speed_.innovation_m_s());
  if (vo.status != VoStatus::kOk || !expected || !(speed_var > 0.0)) return 1.0;
  return scatter_.factor(speed_.innovation_m_s(), speed_.expected_var() + jitter_var, speed_var,
                         dt_s);
}

}  // namespace plumb
