#include "modules/ground/filter/plane_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

constexpr double kStartTiltStd = 1.0 * kDegree;
constexpr double kStartLnHeightStd = 0.1;
constexpr double kSureLnStd = 0.25;  // half of the dense cue's widest sweep

// Normal: pose noise per frame, and road curvature plus suspension per reference step (0.6 camera
// heights).
constexpr double kTurnNoise = 0.05 * kDegree;
constexpr double kCurvatureNoise = 0.08 * kDegree;
// ln h: drift of VO's scale per reference step, and per square root of a radian turned.
constexpr double kScaleDrift = 0.004;
constexpr double kTurnScaleDrift = 0.01;
constexpr double kReferenceStepRatio = 0.6;
constexpr double kLargestNoiseSteps = 2.0;

// Cars do not lean much against their road; keeps roll bounded when the road shows nothing.
constexpr double kLevelRollStd = 4.5 * kDegree;

// How strongly a drive's road bends is the mean over that much way, in camera heights.
constexpr double kBendStrengthRatio = 15.0;
constexpr double kLeastBendStd = 0.05 * kDegree;

constexpr double kNu = 4.0;           // Student-t degrees of freedom of the innovations
constexpr double kScalarGate = 16.0;  // e^2 / S
constexpr double kPlaneGate = 8.0;    // the same per degree of freedom
constexpr int kLockOutFrames = 10;
constexpr double kLockOutLnStd = 0.15;

}  // namespace

Eigen::Vector3d normal_of_state(const Eigen::Vector3d& x) {
  return {x(0), std::sqrt(std::max(0.1, 1.0 - x(0) * x(0) - x(1) * x(1))), x(1)};
}

Eigen::Matrix<double, 3, 2> normal_jacobian(const Eigen::Vector3d& x) {
  const double n2 = normal_of_state(x).y();
  Eigen::Matrix<double, 3, 2> J;
  J << 1.0, 0.0, -x(0) / n2, -x(1) / n2, 0.0, 1.0;
  return J;
}

Eigen::Matrix3d plane_jacobian(const Eigen::Vector3d& x) {
  const double inverse_height = std::exp(-x(2));
  Eigen::Matrix3d J;
  J.leftCols<2>() = normal_jacobian(x);
  J.col(2) = -normal_of_state(x);
  return inverse_height * J;
}

Eigen::Matrix<double, 3, 4> PlaneFilter::ahead_jacobian(const RoadBend& bend) {
  Eigen::Matrix<double, 3, 4> J = Eigen::Matrix<double, 3, 4>::Identity();
  J.col(3) << 0.0, 1.0, bend.height_slope;
  return J;
}

double PlaneFilter::ahead_var(const Eigen::RowVector3d& g) const {
  const Eigen::RowVector4d h = g * to_ahead_ - Eigen::RowVector4d::Unit(2);
  return h * P_ * h.transpose();
}

double PlaneFilter::height() const { return std::exp(x_(2)); }

double PlaneFilter::ln_height_std() const { return std::sqrt(P_(2, 2)); }

bool PlaneFilter::sure() const { return started_ && ln_height_std() < kSureLnStd; }

void PlaneFilter::start(const Eigen::Vector3d& normal, double ln_height) {
  started_ = true;
  num_refused_frames_ = 0;
  bend_var_ = square(bend_.start_std);
  x_ << normal.x(), normal.z(), ln_height, 0.0;
  P_ = Eigen::Vector4d(square(kStartTiltStd), square(kStartTiltStd), square(kStartLnHeightStd),
                       bend_var_)
           .asDiagonal();
}

void PlaneFilter::change_unit(double ln_ratio_std) {
  num_refused_frames_ = 0;
  if (std::isnan(ln_ratio_std)) {
    started_ = false;
    return;
  }
  P_(2, 2) += ln_ratio_std * ln_ratio_std;
}

void PlaneFilter::predict(const Eigen::Matrix3d& R_prev_cam, double step_ratio) {
  // n_cam = R_prev_cam^T n_prev, restricted to (n1, n3).
  const Eigen::Matrix3d R_cam_prev = R_prev_cam.transpose();
  const Eigen::Matrix<double, 3, 2> dn = R_cam_prev * normal_jacobian(state());
  Eigen::Matrix4d F = Eigen::Matrix4d::Identity();
  F.topLeftCorner<1, 2>() = dn.row(0);
  F.block<1, 2>(1, 0) = dn.row(2);
  const Eigen::Vector3d n = R_cam_prev * normal();
  x_(0) = n.x();
  x_(1) = n.z();
  const double steps = std::min(kLargestNoiseSteps, step_ratio / kReferenceStepRatio);
  const double tilt = kTurnNoise + kCurvatureNoise * steps;
  P_ = F * P_ * F.transpose();
  P_(0, 0) += tilt * tilt;
  P_(1, 1) += tilt * tilt;
  const double turned_rad = log_so3(R_prev_cam).norm();
  P_(2, 2) += kScaleDrift * kScaleDrift * steps + kTurnScaleDrift * kTurnScaleDrift * turned_rad;
  predict_bend(step_ratio);
}

/// First-order Gauss-Markov over the way, as strong as bends have been: flat drives must not take the cues' errors for
/// bends, nor hilly ones bends for errors.
void PlaneFilter::predict_bend(double step_ratio) {
  if (bend_.start_std <= 0.0) return;
  const double old = std::exp(-step_ratio / kBendStrengthRatio);
  bend_var_ =
      std::max(square(kLeastBendStd), old * bend_var_ + (1.0 - old) * (square(x_(3)) + P_(3, 3)));
  const double keep = std::exp(-step_ratio / bend_.memory_ratio);
  x_(3) *= keep;
  P_.row(3) *= keep;
  P_.col(3) *= keep;
  P_(3, 3) += (1.0 - keep * keep) * bend_var_;
}

bool PlaneFilter::update_scalar(const Eigen::RowVector4d& H, double residual, double var,
                                bool robust) {
  double S = H * P_ * H.transpose() + var;
  if (robust) {
    const double e2 = residual * residual / S;
    if (e2 > kScalarGate) return false;
    var *= (kNu + e2) / (kNu + 1.0);
    S = H * P_ * H.transpose() + var;
  }
  const Eigen::Vector4d K = P_ * H.transpose() / S;
  x_ += K * residual;
  const Eigen::Matrix4d IKH = Eigen::Matrix4d::Identity() - K * H;
  P_ = IKH * P_ * IKH.transpose() + var * K * K.transpose();
  return true;
}

void PlaneFilter::observe_level_roll() {
  (void)update_scalar(Eigen::RowVector4d::UnitX(), -x_(0), kLevelRollStd * kLevelRollStd, false);
}

void PlaneFilter::observe_travel(const Eigen::Vector3d& direction, double var) {
  Eigen::RowVector4d H = Eigen::RowVector4d::Zero();
  H.head<2>() = direction.transpose() * normal_jacobian(state());
  (void)update_scalar(H, -normal().dot(direction), var, false);
}

bool PlaneFilter::observe_pitch(double n3, double var) {
  return update_scalar(to_ahead_.row(1), n3 - ahead()(1), var, true);
}

bool PlaneFilter::observe_plane(const Eigen::Vector3d& state, const Eigen::Matrix3d& cov) {
  const Eigen::Vector3d residual = state - ahead();
  const Eigen::Matrix3d expected = ahead_cov();
  Eigen::Matrix3d R = cov;
  const double e2 = residual.dot((expected + R).ldlt().solve(residual)) / 3.0;
  if (e2 > kPlaneGate) return false;
  R *= (kNu + e2) / (kNu + 1.0);
  const Eigen::Matrix<double, 4, 3> K = P_ * to_ahead_.transpose() * (expected + R).inverse();
  x_ += K * residual;
  const Eigen::Matrix4d IKH = Eigen::Matrix4d::Identity() - K * to_ahead_;
  P_ = IKH * P_ * IKH.transpose() + K * R * K.transpose();
  return true;
}

bool PlaneFilter::observe_point(const Eigen::Vector3d& centre, double var) {
  const Eigen::Vector3d plane = ahead();
  const double height = normal_of_state(plane).dot(centre);
  if (!(height > 0.0)) return false;
  Eigen::RowVector3d g;
  g.head<2>() = -(centre / height).transpose() * normal_jacobian(plane);
  g(2) = 1.0;
  return update_scalar(g * to_ahead_, std::log(height) - plane(2), var, true);
}

void PlaneFilter::end_frame(bool any_used, bool any_refused) {
  if (any_used) num_refused_frames_ = 0;
  if (any_used || !any_refused) return;
  if (++num_refused_frames_ < kLockOutFrames) return;
  num_refused_frames_ = 0;
  P_(2, 2) += kLockOutLnStd * kLockOutLnStd;
}

}  // namespace plumb
