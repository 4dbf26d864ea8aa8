/// How far the cues err in a frame: one interface for every model of their covariances.
///
/// Units:
///   Variances of (n1, n3, ln h), as the filter has them.
#pragma once

#include <Eigen/Core>

#include "modules/ground/filter/road_bend.hpp"
#include "modules/ground/types/cue_measurements.hpp"

namespace plumb {

/// What is known about the frame besides the cues themselves.
struct CueContext {
  double turn_ratio = 0.0;  ///< |curvature of the path| times camera height
  double step_ratio = 1.0;  ///< motion since the previous image in camera heights
};

/// What the errors of the reported plane depend on besides the filter's own covariance
/// (residual_statistics.hpp). Squares of the angles between what a cue measures and the fused
/// normal; means are taken over the last camera heights travelled.
struct PlaneContext {
  CueContext cue;                ///< of the last frame that was measured
  double dense_n1_square = 0.0;  ///< mean
  double dense_n3_square = 0.0;  ///< of this frame; the mean where the dense cue was not used
  double chord_square = 0.0;     ///< mean
};

/// Variances that are added to the filter's.
struct PlaneVariance {
  double pitch_rad2 = 0.0;
  double roll_rad2 = 0.0;
  double ln_height = 0.0;
};

class CueCovariance {
 public:
  virtual ~CueCovariance() = default;
  /// Covariance of (n1, n3, ln h) from the dense cue in this frame alone. @pre dense.ok
  [[nodiscard]] virtual Eigen::Matrix3d dense(const DenseMeasurement& dense,
                                              const CueContext& context) const = 0;
  /// Variance of ln(n . centre). @pre points.ok
  [[nodiscard]] virtual double points(const PointsMeasurement& points,
                                      const CueContext& context) const = 0;
  /// Variance of n . direction, n of the road under the car. @pre chord.valid
  [[nodiscard]] virtual double chord(const Chord& chord, const CueContext& context) const = 0;
  /// Number of neighbouring images that share one independent error of the height, at least 1. A
  /// filter over images multiplies the height's variance by it. It does not multiply the tilt's: a
  /// car pitches from image to image, and a filter that does not follow takes a crest for a change
  /// of scale.
  [[nodiscard]] virtual double dense_correlated_images(const CueContext& context) const = 0;
  [[nodiscard]] virtual double points_correlated_images(const CueContext& context) const = 0;
  /// The same for the pitch from detected objects: their heights and their road change slowly.
  [[nodiscard]] virtual double objects_correlated_images() const = 0;
  [[nodiscard]] virtual RoadBend road_bend() const = 0;
  /// Confidence in [0, 1], for display and as the least quality that enters the fusion.
  [[nodiscard]] virtual double dense_quality(const DenseMeasurement& dense) const = 0;
  [[nodiscard]] virtual double points_quality(const PointsMeasurement& points) const = 0;
  /// Variance that is reported on top of the filter's; zero where it was never measured.
  [[nodiscard]] virtual PlaneVariance plane(const PlaneContext& /*context*/) const { return {}; }
  /// 1-sigma of the part of ln scale that stays the same in all frames of a drive, so that no frame
  /// can show it.
  [[nodiscard]] virtual double ln_scale_bias_std() const { return 0.0; }
};

/// Factor by which the errors of a cue stay correlated for longer in a turn; 1 when straight on.
[[nodiscard]] double turn_correlation(const CueContext& context);

/// Multiplies the variance of ln h, given the normal, by `num_images`. What follows from the tilt
/// stays.
[[nodiscard]] Eigen::Matrix3d with_correlated_height(const Eigen::Matrix3d& cov, double num_images);

/// Information of (n1, n3, ln h) in the dense cue from pixel noise alone; never singular.
/// `noise_ratio`: standard deviation of the residuals over the assumed one.
[[nodiscard]] Eigen::Matrix3d state_information(const DenseMeasurement& dense,
                                                double noise_ratio = 1.0);

/// d(ln h given the normal) / d(n1, n3).
[[nodiscard]] Eigen::RowVector2d given_slope(const Eigen::Matrix3d& state_information);

}  // namespace plumb
