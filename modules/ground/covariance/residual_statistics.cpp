#include "modules/ground/covariance/residual_statistics.hpp"

#include <cmath>

#include "core/numbers.hpp"
#include "modules/ground/types/plane_state.hpp"

namespace plumb {
namespace {

// About the length of road that the cues look at.
constexpr double kMeanLengthRatio = 5.0;

}  // namespace

void ResidualStatistics::add(const ResidualFrame& frame, const Eigen::Vector3d& plane) {
  context_.cue = frame.context;
  const double keep = std::exp(-frame.context.step_ratio / kMeanLengthRatio);
  const auto mix = [keep](bool seen, double now, double* mean) {
    *mean = seen ? keep * *mean + (1.0 - keep) * now : now;
  };
  const double chord = square(normal_of_state(plane).dot(frame.chord_direction));
  mix(chord_seen_, chord, &context_.chord_square);
  chord_seen_ = true;
  context_.dense_n3_square = dense_n3_mean_;
  if (frame.dense == nullptr) return;
  const Eigen::Vector3d residual = state_of_plane(frame.dense->q) - plane;
  context_.dense_n3_square = square(residual(1));
  mix(dense_seen_, square(residual(0)), &context_.dense_n1_square);
  mix(dense_seen_, square(residual(1)), &dense_n3_mean_);
  dense_seen_ = true;
}

}  // namespace plumb
