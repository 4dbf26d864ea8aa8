/// Covariances out of a trained model.
///
/// The dense cue's covariance is built of what the model tells: variances of n1 and n3, and of ln h once the normal is
/// known; how ln h follows the normal comes from the frame's own pixels. Memory  none.
#pragma once

#include "modules/ground/covariance/cue_covariance.hpp"
#include "modules/ground/covariance/ground_model.hpp"

namespace plumb {

class LearnedCovariance final : public CueCovariance {
 public:
  explicit LearnedCovariance(const GroundModel& model) : model_(model) {}

  [[nodiscard]] Eigen::Matrix3d dense(const DenseObservation& dense,
                                      const CueContext& context) const override;
  [[nodiscard]] double points(const PointsObservation& points,
                              const CueContext& context) const override;
  [[nodiscard]] double travel(const Travel& travel, const CueContext& context) const override;
  [[nodiscard]] double dense_repetition(const CueContext& context) const override;
  [[nodiscard]] double points_repetition(const CueContext& context) const override;
  [[nodiscard]] double objects_repetition() const override { return model_.objects_repetition; }
  [[nodiscard]] RoadBend road_bend() const override { return model_.bend; }
  [[nodiscard]] double dense_quality(const DenseObservation& dense) const override;
  [[nodiscard]] double points_quality(const PointsObservation& points) const override;
  [[nodiscard]] PlaneVariance plane(const PlaneContext& context) const override;
  [[nodiscard]] double ln_scale_bias_std() const override { return model_.ln_scale_bias_std; }

 private:
  GroundModel model_;
};

/// Sum of the correlations e^(-k step / memory) over all k: how many images share one independent error.
[[nodiscard]] double repetition_of(double memory_ratio, double step_ratio);

}  // namespace plumb
