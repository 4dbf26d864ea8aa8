#include "modules/ground/covariance/cue_report.hpp"

#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

CueObservation dense_observation(const GroundSight& sight, const CueCovariance& covariance) {
  CueObservation seen = absent_cue();
  seen.status = sight.dense_status;
  if (!sight.dense.ok) return seen;
  const Eigen::Vector3d state = state_of_plane(sight.dense.q);
  const Eigen::Matrix3d cov = covariance.dense(sight.dense, sight.context);
  seen.height = std::exp(state(2));
  seen.n1 = state(0);
  seen.n3 = state(1);
  seen.height_var = seen.height * seen.height * cov(2, 2);
  seen.n1_var = cov(0, 0);
  seen.n3_var = cov(1, 1);
  seen.quality = covariance.dense_quality(sight.dense);
  return seen;
}

CueObservation points_observation(const GroundSight& sight, const CueCovariance& covariance) {
  CueObservation seen = absent_cue();
  seen.status = sight.points_status;
  if (!sight.points.ok) return seen;
  seen.height = std::exp(sight.points.ln_height);
  seen.height_var = seen.height * seen.height * covariance.points(sight.points, sight.context);
  seen.quality = covariance.points_quality(sight.points);
  return seen;
}

CueObservation objects_observation(const GroundSight& sight) {
  CueObservation seen = absent_cue();
  seen.status = sight.objects_status;
  if (sight.objects_status == CueStatus::kAbsent) return seen;
  seen.n3 = sight.objects.n3;
  seen.n3_var = sight.objects.n3_var;
  seen.quality = sight.objects.quality;
  seen.features = {sight.objects.belief};
  seen.num_features = 1;
  return seen;
}

}  // namespace

CueObservation absent_cue() {
  return {CueStatus::kAbsent, kNan, kNan, kNan, kNan, kNan, kNan, 0.0, {}, 0};
}

std::array<CueObservation, kNumCues> observations_of(const GroundSight& sight,
                                                     const CueCovariance& covariance) {
  static_assert(kCueDense == 0 && kCuePoints == 1 && kCueObjects == 2);
  return {dense_observation(sight, covariance), points_observation(sight, covariance),
          objects_observation(sight)};
}

}  // namespace plumb
