/// Points cue: the height on which the triangulated road points agree (road_point_vote.hpp), as an
/// observation of ln(n . centre) = ln h.
///
/// Memory:
///   One RoadPointVote.
#pragma once

#include "modules/ground/cues/cue.hpp"
#include "modules/ground/cues/road_point_vote.hpp"

namespace plumb {

class PointsCue final : public Cue {
 public:
  /// The arguments must outlive the cue.
  PointsCue(const FilterConfig& config, const CueCovariance& covariance)
      : config_(config), covariance_(covariance) {}

  [[nodiscard]] Observation measure(const CueFrame& frame, const FramePrior& prior) override;
  [[nodiscard]] HeightMeasurement height_over(const Eigen::Vector3d& plane) const override;

  /// The height that the points give before the filter knows one, over the prior's normal: that of
  /// the vote, else `fallback`, else (with `fallback` 0) a rough one. 0 with too few points.
  [[nodiscard]] double find_height(const VoOutput& vo, const FramePrior& prior, double fallback);

  /// The detail of the last measure().
  [[nodiscard]] const PointsMeasurement& last() const { return last_; }

 private:
  const FilterConfig& config_;
  const CueCovariance& covariance_;
  RoadPointVote vote_;
  PointsMeasurement last_;
  CueContext last_context_;
};

}  // namespace plumb
