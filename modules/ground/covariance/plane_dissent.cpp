#include "modules/ground/covariance/plane_dissent.hpp"

#include <cmath>

#include "core/numbers.hpp"
#include "modules/ground/filter/plane_filter.hpp"

namespace plumb {
namespace {

// About the length of road that the cues look at.
constexpr double kDissentMemoryRatio = 5.0;

}  // namespace

void PlaneDissent::add(const GroundSight& sight, const Eigen::Vector3d& state) {
  context_.cue = sight.context;
  const double keep = std::exp(-sight.context.step_ratio / kDissentMemoryRatio);
  const auto mix = [keep](bool seen, double now, double* mean) {
    *mean = seen ? keep * *mean + (1.0 - keep) * now : now;
  };
  const double travel = square(normal_of_state(state).dot(sight.travel.direction));
  mix(travel_seen_, travel, &context_.travel_square);
  travel_seen_ = true;
  context_.dense_n3_square = dense_n3_mean_;
  if (sight.dense_status != CueStatus::kUsed) return;
  const Eigen::Vector3d apart = state_of_plane(sight.dense.q) - state;
  context_.dense_n3_square = square(apart(1));
  mix(dense_seen_, square(apart(0)), &context_.dense_n1_square);
  mix(dense_seen_, square(apart(1)), &dense_n3_mean_);
  dense_seen_ = true;
}

}  // namespace plumb
