#include "modules/objects/box_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace plumb {
namespace {

constexpr int kIterations = 6;
constexpr double kFreedom = 4.0;      ///< degrees of freedom of Student's t
constexpr double kConverged = 1e-4;   ///< [m, rad, -] a smaller step ends the iteration
constexpr double kLargestStep = 0.7;  ///< largest step of ln sizes and yaw in one iteration
constexpr double kFarthest_m = 500.0;

using Gain = Eigen::Matrix<double, kStateSize, 4>;
using Edges = Eigen::Matrix<double, 4, kStateSize>;

/// Covariance of the edges that comes from the roll and height of the plane and from the inset,
/// which are not part of the state.
Eigen::Matrix4d shared_noise(const ProjectedCuboid& projected, const RoadPlane& plane,
                             const Contact& contact) {
  const Eigen::Matrix<double, 4, 2> J = projected.J_plane.rightCols<2>();
  return J * plane.cov.bottomRightCorner<2, 2>() * J.transpose() +
         contact.inset_std_m * contact.inset_std_m * projected.J_inset *
             projected.J_inset.transpose();
}

constexpr double kNotSeen = 1e12;  ///< [px^2] variance of an edge that has no effect

/// Variances of the edges. A cut edge has no effect when the solution extends beyond it.
Eigen::Vector4d edge_variances(const MeasuredBox& box, const ProjectedCuboid& projected) {
  constexpr std::array<double, 4> kOutward{-1.0, -1.0, 1.0, 1.0};
  Eigen::Vector4d var_px2 = box.var_px2;
  for (int i = 0; i < 4; ++i) {
    const auto edge = static_cast<std::size_t>(i);
    const double beyond = kOutward[edge] * (projected.edges_px(i) - box.edges_px(i));
    if (box.cut[edge] && beyond >= 0.0) var_px2(i) = kNotSeen;
  }
  return var_px2;
}

/// Shortens steps for which the model is not linear enough.
StateVector limited(const StateVector& from, const StateVector& to) {
  double scale = 1.0;
  for (const int row : {kYaw, kLogWidth, kLogRatio, kLogHeight}) {
    const double step = std::abs(to(row) - from(row));
    if (step > kLargestStep) scale = std::min(scale, kLargestStep / step);
  }
  const double step_m = (to - from).head<2>().norm();
  const double most_m = 0.5 * from.head<2>().norm() + 1.0;
  if (step_m > most_m) scale = std::min(scale, most_m / step_m);
  return from + scale * (to - from);
}

}  // namespace

BoxFitResult fit_box(const CameraModel& camera, const RoadPlane& plane, const Contact& contact,
                     const MeasuredBox& box, const StateEstimate& prior) {
  BoxFitResult result;
  StateVector x = prior.x;
  Eigen::Vector4d weight = Eigen::Vector4d::Ones();
  Gain K = Gain::Zero();
  Eigen::Matrix4d S = Eigen::Matrix4d::Identity();
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const auto projected = project_cuboid(camera, plane, x, contact.inset_m);
    if (!projected) return result;
    const Edges& H = projected->J_state;
    const Eigen::Matrix4d shared = shared_noise(*projected, plane, contact);
    S = H * prior.P * H.transpose() + shared;
    const Eigen::Vector4d var_px2 = edge_variances(box, *projected);
    S.diagonal() += var_px2.cwiseQuotient(weight);
    const Eigen::LLT<Eigen::Matrix4d> solver(S);
    K = solver.solve(H * prior.P).transpose();
    const Eigen::Vector4d residual = box.edges_px - projected->edges_px;
    const Eigen::Vector4d innovation = residual - H * (prior.x - x);
    result.cost = innovation.dot(solver.solve(innovation));
    if (iteration == 0) {
      result.chi2 = result.cost;
      result.log_det = 2.0 * solver.matrixLLT().diagonal().array().log().sum();
    }
    const StateVector next = limited(x, prior.x + K * innovation);
    if (!next.allFinite() || next.head<2>().norm() > kFarthest_m) return result;
    const Eigen::Vector4d left = residual - H * (next - x);
    for (int i = 0; i < 4; ++i) {
      const double e2 = left(i) * left(i) / (var_px2(i) + shared(i, i));
      weight(i) = (kFreedom + 1.0) / (kFreedom + std::max(e2, 1.0));
    }
    const double moved = (next - x).cwiseAbs().maxCoeff();
    x = next;
    if (moved < kConverged) break;
  }
  result.estimate.x = x;
  result.estimate.P = prior.P - K * S * K.transpose();
  result.estimate.P = 0.5 * (result.estimate.P + result.estimate.P.transpose()).eval();
  result.ok = true;
  return result;
}

}  // namespace plumb
