/// Dense cue: the plane that aligns the road of the newest image with older ones
/// (dense_alignment.hpp), as an observation of (n1, n3, ln h).
///
/// Until the filter has converged, a frame in which the alignment fails at the prior's height is
/// searched over a range of heights: at high speed VO may track nothing nearby, and then no road
/// point gives a height to start from.
///
/// Memory:
///   One DenseAlignment.
#pragma once

#include "modules/ground/cues/cue.hpp"
#include "modules/ground/cues/dense_alignment.hpp"
#include "modules/ground/cues/image_ring.hpp"
#include "modules/ground/cues/row_clock.hpp"

namespace plumb {

class DenseCue final : public Cue {
 public:
  /// The arguments must outlive the cue. `clock` is told of every image before measure().
  DenseCue(const FilterConfig& config, const CueCovariance& covariance, const ImageRing& images,
           const RowClock& clock);

  [[nodiscard]] Observation measure(const CueFrame& frame, const FramePrior& prior) override;
  [[nodiscard]] HeightMeasurement height_over(const Eigen::Vector3d& plane) const override;

  /// The detail of the last measure(), to which its Observation refers.
  [[nodiscard]] const DenseMeasurement& last() const { return last_; }

 private:
  /// One alignment at the prior's height.
  struct Attempt {
    bool looked = false;  ///< there were images to compare
    DenseMeasurement dense;
  };

  [[nodiscard]] Attempt align(const CueFrame& frame, const FramePrior& prior);
  /// What the heights tried at the start came to.
  struct Found {
    DenseMeasurement best;      ///< not ok when there is none
    bool sure = false;          ///< good enough, and not contradicted
    bool contradicted = false;  ///< another height explains the road about as well
  };

  [[nodiscard]] Observation start(const CueFrame& frame, const FramePrior& prior);
  [[nodiscard]] Found search(const CueFrame& frame, const FramePrior& prior,
                             const DenseMeasurement& expected);
  [[nodiscard]] Observation observed(const FramePrior& prior, const FramePrior& next,
                                     CueStatus status);

  const FilterConfig& config_;
  const CueCovariance& covariance_;
  const ImageRing& images_;
  const RowClock& clock_;
  DenseAlignment alignment_;
  DenseMeasurement last_;
  CueContext last_context_;
};

}  // namespace plumb
