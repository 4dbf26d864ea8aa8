#include "modules/ground/cues/points_cue.hpp"

#include <cmath>

#include "modules/ground/types/plane_state.hpp"

namespace plumb {

Observation PointsCue::measure(const CueFrame& frame, const FramePrior& prior) {
  Observation out = nothing_observed(prior);
  last_ = {};
  last_context_ = prior.context;
  if (!prior.measurable) return out;
  last_ = vote_.measure(*frame.vo,
                        {prior.normal_cam, prior.height, config_.least_ray_slope, prior.road});
  if (last_.num_candidates == 0) return out;
  const bool good = last_.ok && last_.num_inliers >= config_.least_points;
  out.report.status = good ? CueStatus::kUsed : CueStatus::kFailed;
  if (!last_.ok) return out;
  const double var = covariance_.points(last_, prior.context);
  out.report.height = std::exp(last_.ln_height);
  out.report.height_var = out.report.height * out.report.height * var;
  out.report.quality = covariance_.points_quality(last_);
  if (!good) return out;
  out.plane.function = observe_point;
  out.plane.value = last_.centre;
  out.plane.cov(0, 0) = covariance_.points_correlated_images(prior.context) * var;
  out.plane.first_component = 2;
  if (last_.num_inliers >= config_.start_points) out.start_ln_height = last_.ln_height;
  return out;
}

HeightMeasurement PointsCue::height_over(const Eigen::Vector3d& plane) const {
  const double height = normal_of_state(plane).dot(last_.centre);
  return {std::log(height), covariance_.points(last_, last_context_),
          last_.centre.transpose() * normal_jacobian(plane) / height};
}

double PointsCue::find_height(const VoOutput& vo, const FramePrior& prior, double fallback) {
  const PointsMeasurement found =
      vote_.measure(vo, {prior.normal_cam, 0.0, config_.least_ray_slope, prior.road});
  if (found.ok && found.num_inliers >= config_.start_points) return std::exp(found.ln_height);
  return fallback > 0.0 ? fallback : vote_.rough_height(vo, prior.normal_cam);
}

}  // namespace plumb
