#include "modules/ground/filter/plane_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/se3.hpp"

namespace plumb {
namespace {

// Places in the state.
constexpr int kBend = 3;
constexpr int kSpeedError = 4;

// Distance in camera heights over which the error of the road's speed stays correlated.
constexpr double kSpeedErrorLength = 400.0;

}  // namespace

PlaneFilter::Jacobian PlaneFilter::ahead_jacobian(const RoadBend& bend) {
  Jacobian J = Jacobian::Identity();
  J.col(kBend) << 0.0, 1.0, bend.height_slope;
  return J;
}

double PlaneFilter::ahead_var(const Eigen::RowVector3d& g) const {
  const Row h = g * to_ahead_ - Row::Unit(2);
  return h * P_ * h.transpose();
}

double PlaneFilter::height() const { return std::exp(x_(2)); }

double PlaneFilter::ln_height_std() const { return std::sqrt(P_(2, 2)); }

bool PlaneFilter::converged() const {
  return started_ && ln_height_std() < config_.converged_ln_std;
}

void PlaneFilter::start(const Eigen::Vector3d& normal, double ln_height) {
  started_ = true;
  num_rejected_frames_ = 0;
  bend_var_ = square(bend_.start_std);
  x_ << normal.x(), normal.z(), ln_height, 0.0, 0.0;
  const double tilt_var = square(config_.start_tilt_std_rad);
  State var;
  var << tilt_var, tilt_var, square(config_.start_ln_height_std), bend_var_, speed_error_var_;
  P_ = var.asDiagonal();
}

void PlaneFilter::change_unit(double ln_ratio_std) {
  num_rejected_frames_ = 0;
  if (std::isnan(ln_ratio_std)) {
    reset();
    return;
  }
  P_(2, 2) += ln_ratio_std * ln_ratio_std;
}

void PlaneFilter::change_height(double ln_ratio) { x_(2) += ln_ratio; }

void PlaneFilter::predict(const Eigen::Matrix3d& R_prev_cam, double step_ratio) {
  // n_cam = R_prev_cam^T n_prev, restricted to (n1, n3).
  const Eigen::Matrix3d R_cam_prev = R_prev_cam.transpose();
  const Eigen::Matrix<double, 3, 2> dn = R_cam_prev * normal_jacobian(state());
  Covariance F = Covariance::Identity();
  F.topLeftCorner<1, 2>() = dn.row(0);
  F.block<1, 2>(1, 0) = dn.row(2);
  const Eigen::Vector3d n = R_cam_prev * normal();
  x_(0) = n.x();
  x_(1) = n.z();
  const double steps =
      std::min(config_.largest_noise_steps, step_ratio / config_.reference_step_ratio);
  const double tilt = config_.turn_noise_rad + config_.curvature_noise_rad * steps;
  P_ = F * P_ * F.transpose();
  P_(0, 0) += tilt * tilt;
  P_(1, 1) += tilt * tilt;
  const double turned_rad = log_so3(R_prev_cam).norm();
  P_(2, 2) +=
      square(config_.scale_drift_std) * steps + square(config_.turn_scale_drift_std) * turned_rad;
  predict_bend(step_ratio);
  fade(kSpeedError, std::exp(-step_ratio / kSpeedErrorLength), speed_error_var_);
}

/// The bend's strength is that of this drive so far: on flat drives errors of the cues must not
/// pass for bends, and on hilly ones bends must not pass for errors.
void PlaneFilter::predict_bend(double step_ratio) {
  if (bend_.start_std <= 0.0) return;
  const double old = std::exp(-step_ratio / config_.bend_strength_ratio);
  bend_var_ = std::max(square(config_.least_bend_std),
                       old * bend_var_ + (1.0 - old) * (square(x_(kBend)) + P_(kBend, kBend)));
  fade(kBend, std::exp(-step_ratio / bend_.correlation_length_ratio), bend_var_);
}

/// Predicts a component that is a first-order Gauss-Markov process of this variance.
void PlaneFilter::fade(int component, double keep, double var) {
  x_(component) *= keep;
  P_.row(component) *= keep;
  P_.col(component) *= keep;
  P_(component, component) += (1.0 - keep * keep) * var;
}

void PlaneFilter::doubt_height(double var) {
  P_(2, 2) += var;
  x_(kSpeedError) = 0.0;
  P_.row(kSpeedError).setZero();
  P_.col(kSpeedError).setZero();
  P_(kSpeedError, kSpeedError) = speed_error_var_;
}

PlaneObservation PlaneFilter::level_roll() const {
  PlaneObservation level;
  level.function = observe_level;
  level.cov(0, 0) = config_.level_roll_std_rad * config_.level_roll_std_rad;
  level.road = RoadPart::kUnderCar;
  level.gated = false;
  return level;
}

FuseResult PlaneFilter::fuse(const PlaneObservation& observation) {
  const bool is_ahead = observation.road == RoadPart::kAhead;
  const Linearisation at = observation.function(observation.value, is_ahead ? ahead() : state());
  if (at.num_rows == 0) return {};
  Jacobian H = Jacobian::Zero();
  if (is_ahead) {
    H = at.jacobian * to_ahead_;
  } else {
    H.leftCols<3>() = at.jacobian;
  }
  if (observation.speed_error_var > 0.0) {
    know_speed_error(observation.speed_error_var);
    H(0, kSpeedError) = 1.0;
    return fuse_scalar(H.row(0), at.innovation(0) - x_(kSpeedError), observation);
  }
  return at.num_rows == 1 ? fuse_scalar(H.row(0), at.innovation(0), observation)
                          : fuse_plane(H, at.innovation, observation);
}

/// The variance of the road's speed is stated with it. What was not known of it before, nothing has
/// told yet.
void PlaneFilter::know_speed_error(double var) {
  const double known = P_(kSpeedError, kSpeedError);
  if (var > speed_error_var_) P_(kSpeedError, kSpeedError) = known + var - speed_error_var_;
  speed_error_var_ = var;
}

FuseResult PlaneFilter::fuse_scalar(const Row& H, double innovation,
                                    const PlaneObservation& observation) {
  FuseResult result;
  result.innovation(observation.first_component) = innovation;
  double var = observation.cov(0, 0);
  double S = H * P_ * H.transpose() + var;
  if (observation.gated) {
    const double e2 = innovation * innovation / S;
    result.test_ratio = e2 / config_.scalar_gate;
    if (e2 > config_.scalar_gate) return result;
    var *= (config_.student_t_dof + e2) / (config_.student_t_dof + 1.0);
    S = H * P_ * H.transpose() + var;
  }
  const State K = P_ * H.transpose() / S;
  x_ += K * innovation;
  const Covariance IKH = Covariance::Identity() - K * H;
  P_ = IKH * P_ * IKH.transpose() + var * K * K.transpose();
  result.accepted = true;
  return result;
}

FuseResult PlaneFilter::fuse_plane(const Jacobian& H, const Eigen::Vector3d& innovation,
                                   const PlaneObservation& observation) {
  FuseResult result;
  result.innovation = innovation;
  const Eigen::Matrix3d expected = H * P_ * H.transpose();
  Eigen::Matrix3d R = observation.cov;
  if (observation.gated) {
    const double e2 = innovation.dot((expected + R).ldlt().solve(innovation)) / 3.0;
    result.test_ratio = e2 / config_.plane_gate;
    if (e2 > config_.plane_gate) return result;
    R *= (config_.student_t_dof + e2) / (config_.student_t_dof + 1.0);
  }
  const Eigen::Matrix<double, kSize, 3> K = P_ * H.transpose() * (expected + R).inverse();
  x_ += K * innovation;
  const Covariance IKH = Covariance::Identity() - K * H;
  P_ = IKH * P_ * IKH.transpose() + K * R * K.transpose();
  result.accepted = true;
  return result;
}

void PlaneFilter::end_frame(bool any_used, bool any_rejected) {
  if (any_used) num_rejected_frames_ = 0;
  if (any_used || !any_rejected) return;
  if (++num_rejected_frames_ < config_.lock_out_frames) return;
  num_rejected_frames_ = 0;
  P_(2, 2) += config_.lock_out_ln_std * config_.lock_out_ln_std;
}

}  // namespace plumb
