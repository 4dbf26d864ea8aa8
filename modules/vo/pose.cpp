#include "modules/vo/pose.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "modules/vo/projection.hpp"

namespace plumb::vo {
namespace {

constexpr double kPoseCauchy2 = 4.0;  // c^2 of the kernel
constexpr double kConvergedStep = 1e-7;

using PoseTable = std::array<Se3, kMaxFrames>;  // by slot

struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  double sum_inlier_px2 = 0.0;
};

// Adds the weighted normal equations of one point.
void add_point(const Track& track, const Se3& T_cam_host, const Eigen::Vector2d& focal_px,
               double kernel2, NormalEquations* normal, PoseFit* fit) {
  const PointInFrame p = transfer(T_cam_host, track.host_xy, track.rho, track.xy, focal_px);
  if (!p.in_front) return;
  const Matrix23d D = projection_jacobian(p.Y, focal_px);
  const Eigen::Vector2d d = D * T_cam_host.t;

  // The inverse of S = s2 I + v d d^T is (I - k d d^T) / s2 by the Sherman-Morrison formula.
  const double s2 = kPixelStd * kPixelStd;
  const double v = track.rho_std * track.rho_std;
  const double k = v / (s2 + v * d.squaredNorm());
  const double rd = p.residual_px.dot(d);
  const double e2 = (p.residual_px.squaredNorm() - k * rd * rd) / s2;
  const double weight = 1.0 / ((1.0 + e2 / kernel2) * s2);

  ++fit->num_points;
  if (e2 < kInlierChi2) {
    ++fit->num_inliers;
    normal->sum_inlier_px2 += e2 * s2;
  }
  const Matrix26d J = frame_jacobian(D, p.Y, track.rho);
  const Vector6d a = J.row(0).transpose();
  const Vector6d c = J.row(1).transpose();
  const Vector6d g = d.x() * a + d.y() * c;
  normal->H.noalias() += (weight * a) * a.transpose();
  normal->H.noalias() += (weight * c) * c.transpose();
  normal->H.noalias() -= (weight * k * g) * g.transpose();
  normal->b += weight * (a * p.residual_px.x() + c * p.residual_px.y() - (k * rd) * g);
}

// A rotation about the camera centre does not change R^T t. With T <- (E R, E t), the step (d, w)
// is (0, w).
bool solve(const NormalEquations& normal, bool rotation_only, Vector6d* step) {
  step->setZero();
  if (rotation_only) {
    const Eigen::Matrix3d H = normal.H.bottomRightCorner<3, 3>();
    step->tail<3>() = H.ldlt().solve(normal.b.tail<3>());
  } else {
    Matrix6d H = normal.H;
    H.diagonal() *= 1.0 + 1e-6;
    H.diagonal().head<3>().array() += 1e-9;
    *step = H.ldlt().solve(normal.b);
  }
  return step->allFinite();
}

// Ratio of the measured variance of the motion to the one by the information matrix.
constexpr double kCovarianceInflation = 4.0;

}  // namespace

PoseFit fit_pose(const Se3& start, const TrackTable& tracks, const Window& window,
                 const Eigen::Vector2d& focal_px, const PoseOptions& options) {
  PoseTable T_world_host;
  for (const int slot : window.order()) {
    T_world_host[static_cast<std::size_t>(slot)] = window[slot].T_cam_world.inverse();
  }
  PoseFit fit;
  fit.T_cam_world = start;
  for (int i = 0; i <= options.max_iterations; ++i) {
    PoseTable T_cam_host;
    for (const int slot : window.order()) {
      const auto s = static_cast<std::size_t>(slot);
      T_cam_host[s] = fit.T_cam_world * T_world_host[s];
    }
    NormalEquations normal;
    fit.num_points = 0;
    fit.num_inliers = 0;
    for (const int index : tracks.active()) {
      const Track& track = tracks[index];
      add_point(track, T_cam_host[static_cast<std::size_t>(track.host)], focal_px,
                kPoseCauchy2 * options.kernel_scale, &normal, &fit);
    }
    fit.information = normal.H;
    fit.rms_px = std::sqrt(normal.sum_inlier_px2 / std::max(1, fit.num_inliers));
    Vector6d step;
    if (i == options.max_iterations || !solve(normal, options.rotation_only, &step)) break;
    perturb(fit.T_cam_world, step);
    if (step.norm() < kConvergedStep) break;
  }
  return fit;
}

Matrix6d motion_covariance(const PoseFit& pose, const Se3& T_prev_world) {
  // T_prev_cam = T_prev_world T_world_cam. The perturbation (d, w) of T_cam_world moves t by
  // -R_prev_cam d and multiplies R by exp(-w) from the right.
  Matrix6d information = pose.information;
  information.diagonal().array() += 1e-9;
  const Matrix6d cov = kCovarianceInflation * information.inverse();
  Matrix6d J = -Matrix6d::Identity();
  J.topLeftCorner<3, 3>() = -(T_prev_world.R * pose.T_cam_world.R.transpose());
  // Eigen rounds a product that is assigned differently from one that initialises a matrix. The
  // assignment keeps the bits of recorded results.
  Matrix6d result;
  result = J * cov * J.transpose();
  return result;
}

}  // namespace plumb::vo
