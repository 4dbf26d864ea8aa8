#include "modules/objects/object_output.hpp"

#include <cmath>

namespace plumb {
namespace {

constexpr double kLeastClosing_m_s = 0.3;

Eigen::Vector3d size_std_of(const StateMatrix& P, const Eigen::Vector3d& size_m) {
  const double length_var =
      P(kLogWidth, kLogWidth) + P(kLogRatio, kLogRatio) + 2.0 * P(kLogWidth, kLogRatio);
  return size_m.cwiseProduct(Eigen::Vector3d(std::sqrt(length_var),
                                             std::sqrt(P(kLogWidth, kLogWidth)),
                                             std::sqrt(P(kLogHeight, kLogHeight))));
}

/// Range of the centre of the footprint over its closing speed.
double time_to_collision(const StateEstimate& estimate, const GroundMotion& motion,
                         bool over_ground) {
  Eigen::Vector2d closing_m_s = estimate.x.segment<2>(kVelocityX);
  if (over_ground && motion.dt_s > 0.0) closing_m_s -= motion.t_m / motion.dt_s;
  const double range_m = estimate.x.head<2>().norm();
  const double rate_m_s = estimate.x.head<2>().dot(closing_m_s) / range_m;
  return rate_m_s < -kLeastClosing_m_s ? range_m / -rate_m_s : kNan;
}

/// Position covariance, including systematic errors: the height of the plane scales all positions
/// together, and the shape of a body shifts its box across the line of sight.
Eigen::Matrix2d position_cov(const StateEstimate& estimate, const TrackView& view) {
  const Eigen::Vector2d position_m = estimate.x.head<2>();
  const Eigen::Vector2d across = Eigen::Vector2d(-position_m.y(), position_m.x()).normalized();
  return estimate.P.topLeftCorner<2, 2>() +
         view.plane.cov(2, 2) * position_m * position_m.transpose() +
         view.objects.side_std_m * view.objects.side_std_m * across * across.transpose();
}

}  // namespace

ObjectOutput output_of(const ObjectTrack& track, const TrackView& view,
                       const GroundMotion& motion) {
  const StateEstimate& estimate = track.estimate();
  const StateMatrix& P = estimate.P;
  ObjectOutput object;
  object.position_m = estimate.x.head<2>();
  object.position_cov_m2 = position_cov(estimate, view);
  object.velocity_valid = track.over_ground();
  object.velocity_m_s = estimate.x.segment<2>(kVelocityX);
  object.velocity_cov_m2_s2 = P.block<2, 2>(kVelocityX, kVelocityX);
  object.yaw_rad = estimate.x(kYaw);
  object.yaw_std_rad = std::sqrt(P(kYaw, kYaw));
  object.size_m = {length_of(estimate.x), width_of(estimate.x), height_of(estimate.x)};
  object.size_std_m = size_std_of(P, object.size_m);
  object.time_to_collision_s = time_to_collision(estimate, motion, track.over_ground());
  return object;
}

}  // namespace plumb
