#include "modules/ground/cues/motion_cue.hpp"

#include <cmath>

namespace plumb {
namespace {

// Share of the deviation that is new in each image. The rest is that of the pitch, which changes
// slowly.
constexpr double kNewShare = 0.25;

}  // namespace

Observation MotionCue::measure(const CueFrame& frame, const FramePrior& prior) {
  Observation out = nothing_observed(prior);
  const double height = frame.vo->road_height;
  if (!(height > 0.0) || !frame.chord.valid) return out;
  const double std = frame.vo->road_height_std;
  last_ = {std::log(height), square(std / height), Eigen::RowVector2d::Zero()};
  out.report.status = CueStatus::kUsed;
  out.report.height = height;
  out.report.height_var = square(std);
  out.report.quality = 1.0;
  out.plane.function = observe_height;
  out.plane.value(0) = last_.ln_height;
  out.plane.cov(0, 0) = square(kNewShare) * last_.var;
  out.plane.speed_error_var = (1.0 - square(kNewShare)) * last_.var;
  out.plane.first_component = 2;
  out.start_ln_height = last_.ln_height;
  out.prior.measurable =
      prior.measurable || frame.chord.length > config_.shortest_chord_ratio * height;
  return out;
}

HeightMeasurement MotionCue::height_over(const Eigen::Vector3d& /*plane*/) const { return last_; }

}  // namespace plumb
