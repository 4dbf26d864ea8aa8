/// Motion cue: the height that VO knows by the speed at which the road passes
/// (vo_motion_t.road_height), as an observation of ln h.
///
/// Memory:
///   Nothing is allocated.
#pragma once

#include "modules/ground/cues/cue.hpp"

namespace plumb {

class MotionCue final : public Cue {
 public:
  /// `config` must outlive the cue.
  explicit MotionCue(const FilterConfig& config) : config_(config) {}

  [[nodiscard]] Observation measure(const CueFrame& frame, const FramePrior& prior) override;
  [[nodiscard]] HeightMeasurement height_over(const Eigen::Vector3d& plane) const override;

 private:
  const FilterConfig& config_;
  HeightMeasurement last_;
};

}  // namespace plumb
