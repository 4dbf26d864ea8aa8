/// Covariances that a trained model predicts for each frame.
///
/// The model gives the variances of n1 and n3, and of ln h given the normal. How ln h depends on
/// the normal follows from the frame's own pixels; together they make the dense cue's covariance.
///
/// Memory:
///   Nothing is allocated.
#pragma once

#include "modules/ground/covariance/cue_covariance.hpp"
#include "modules/ground/covariance/ground_model.hpp"

namespace plumb {

class LearnedCovariance final : public CueCovariance {
 public:
  explicit LearnedCovariance(const GroundModel& model) : model_(model) {}

  [[nodiscard]] Eigen::Matrix3d dense(const DenseMeasurement& dense,
                                      const CueContext& context) const override;
  [[nodiscard]] double points(const PointsMeasurement& points,
                              const CueContext& context) const override;
  [[nodiscard]] double chord(const Chord& chord, const CueContext& context) const override;
  [[nodiscard]] double dense_correlated_images(const CueContext& context) const override;
  [[nodiscard]] double points_correlated_images(const CueContext& context) const override;
  [[nodiscard]] double objects_correlated_images() const override {
    return model_.objects_correlated_images;
  }
  [[nodiscard]] RoadBend road_bend() const override { return model_.bend; }
  [[nodiscard]] double dense_quality(const DenseMeasurement& dense) const override;
  [[nodiscard]] double points_quality(const PointsMeasurement& points) const override;
  [[nodiscard]] PlaneVariance plane(const PlaneContext& context) const override;
  [[nodiscard]] double ln_scale_bias_std() const override { return model_.ln_scale_bias_std; }

 private:
  GroundModel model_;
};

/// Sum of the correlations e^(-k step / length) over all integers k: the number of images that
/// share one independent error, for errors that stay correlated over `correlation_length_ratio`
/// camera heights travelled.
[[nodiscard]] double correlated_images(double correlation_length_ratio, double step_ratio);

}  // namespace plumb
