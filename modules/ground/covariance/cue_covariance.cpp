#include "modules/ground/covariance/cue_covariance.hpp"

#include <Eigen/LU>

#include "modules/ground/types/plane_state.hpp"

namespace plumb {
namespace {

// A road that shows no texture in one direction still has a variance there.
constexpr double kLeastInformation = 1e-3;

// Within one turn the road's crossfall, the car's lean and residual calibration errors keep their
// sign: all images of the turn share one error, and VO's own scale is more accurate. Per unit of
// turn_ratio.
constexpr double kTurnCorrelationGrowth = 40.0;

}  // namespace

double turn_correlation(const CueContext& context) {
  const double growth = 1.0 + kTurnCorrelationGrowth * context.turn_ratio;
  return growth * growth;
}

Eigen::Matrix3d with_correlated_height(const Eigen::Matrix3d& cov, double num_images) {
  const double given_var = 1.0 / cov.inverse()(2, 2);
  Eigen::Matrix3d correlated = cov;
  correlated(2, 2) += (num_images - 1.0) * given_var;
  return correlated;
}

Eigen::Matrix3d state_information(const DenseMeasurement& dense, double noise_ratio) {
  const Eigen::Matrix3d J = plane_jacobian(state_of_plane(dense.q));
  return J.transpose() * dense.information * J / (noise_ratio * noise_ratio) +
         kLeastInformation * Eigen::Matrix3d::Identity();
}

Eigen::RowVector2d given_slope(const Eigen::Matrix3d& state_information) {
  return -state_information.block<1, 2>(2, 0) / state_information(2, 2);
}

}  // namespace plumb
