/// Covariances set by hand: pixel noise plus a floor for what pixel noise does not explain (pose
/// error, heave and road shape). Setting ground.covariance = "fixed"; trained models are compared
/// with it.
#pragma once

#include "modules/ground/covariance/cue_covariance.hpp"

namespace plumb {

class FixedCovariance final : public CueCovariance {
 public:
  [[nodiscard]] Eigen::Matrix3d dense(const DenseMeasurement& dense,
                                      const CueContext& context) const override;
  [[nodiscard]] double points(const PointsMeasurement& points,
                              const CueContext& context) const override;
  [[nodiscard]] double chord(const Chord& chord, const CueContext& context) const override;
  [[nodiscard]] double dense_correlated_images(const CueContext& context) const override;
  [[nodiscard]] double points_correlated_images(const CueContext& context) const override;
  [[nodiscard]] double objects_correlated_images() const override;
  [[nodiscard]] RoadBend road_bend() const override;
  [[nodiscard]] double dense_quality(const DenseMeasurement& dense) const override;
  [[nodiscard]] double points_quality(const PointsMeasurement& points) const override;
};

}  // namespace plumb
