#include "modules/ground/covariance/seen_height.hpp"

#include <Eigen/LU>
#include <cmath>

#include "modules/ground/covariance/cue_covariance.hpp"
#include "modules/ground/filter/plane_filter.hpp"

namespace plumb {

double height_given_normal(const DenseObservation& dense, const Eigen::Vector3d& n) {
  return n.dot(dense.information * n) / n.dot(dense.information * dense.q);
}

SeenHeight see_height(const GroundSight& sight, const CueCovariance& covariance,
                      const Eigen::Vector3d& state) {
  const Eigen::Vector3d normal = normal_of_state(state);
  SeenHeight sum;
  double information = 0.0;
  const auto add = [&](double height, double var, const Eigen::RowVector2d& slope) {
    information += 1.0 / var;
    sum.ln_height += std::log(height) / var;
    sum.slope += slope / var;
  };
  if (sight.dense_status == CueStatus::kUsed) {
    const Eigen::Matrix3d cov = covariance.dense(sight.dense, sight.context);
    add(height_given_normal(sight.dense, normal), 1.0 / cov.inverse()(2, 2),
        given_slope(state_information(sight.dense)));
  }
  if (sight.points_status == CueStatus::kUsed) {
    const double height = normal.dot(sight.points.centre);
    add(height, covariance.points(sight.points, sight.context),
        sight.points.centre.transpose() * normal_jacobian(state) / height);
  }
  return {sum.ln_height / information, 1.0 / information, sum.slope / information};
}

}  // namespace plumb
