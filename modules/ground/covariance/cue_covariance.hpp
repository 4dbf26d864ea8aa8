/// How far each cue is trusted in this frame. One interface, so that models can be exchanged.
///
/// Units  variances of the filter's state (n1, n3, ln h).
#pragma once

#include <Eigen/Core>

#include "modules/ground/covariance/ground_model.hpp"
#include "modules/ground/cues/dense_cue.hpp"
#include "modules/ground/cues/points_cue.hpp"
#include "modules/ground/cues/travel.hpp"
#include "modules/ground/filter/road_bend.hpp"

namespace plumb {

/// What is known about the frame besides the cues themselves.
struct CueContext {
  double turn_ratio = 0.0;  ///< |curvature of the path| times camera height
  double step_ratio = 1.0;  ///< motion since the previous image, in camera heights
};

/// What the errors of the reported plane follow besides the filter's own covariance. Squares of the angles (n1, n3) by
/// which a cue leaves the fused normal; means are over the last camera heights of way.
struct PlaneContext {
  CueContext cue;                ///< of the last frame that looked for cues
  double dense_n1_square = 0.0;  ///< mean
  double dense_n3_square = 0.0;  ///< in this frame; the mean where the dense cue saw nothing
  double travel_square = 0.0;    ///< mean
};

/// Beside what the filter says of (pitch, roll, ln height).
struct PlaneVariance {
  double pitch_rad2 = 0.0;
  double roll_rad2 = 0.0;
  double ln_height = 0.0;
};

class CueCovariance {
 public:
  virtual ~CueCovariance() = default;
  /// Of (n1, n3, ln h) out of the dense cue, in this frame alone. @pre dense.ok
  [[nodiscard]] virtual Eigen::Matrix3d dense(const DenseObservation& dense,
                                              const CueContext& context) const = 0;
  /// Of ln(n . centre). @pre points.ok
  [[nodiscard]] virtual double points(const PointsObservation& points,
                                      const CueContext& context) const = 0;
  /// Of n . direction under the car. @pre travel.valid
  [[nodiscard]] virtual double travel(const Travel& travel, const CueContext& context) const = 0;
  /// How many neighbouring images share one independent error of the height, at least 1: a filter over images takes its
  /// variance that many times. The tilt's is taken once: a car pitches on from image to image, and a filter that trusts
  /// no tilt lags behind and takes a crest for a change of scale.
  [[nodiscard]] virtual double dense_repetition(const CueContext& context) const = 0;
  [[nodiscard]] virtual double points_repetition(const CueContext& context) const = 0;
  /// The same for the pitch of detected objects: their heights and the road under them change slowly.
  [[nodiscard]] virtual double objects_repetition() const = 0;
  [[nodiscard]] virtual RoadBend road_bend() const = 0;
  /// Belief in [0, 1], for display and for the least quality that enters the fusion.
  [[nodiscard]] virtual double dense_quality(const DenseObservation& dense) const = 0;
  [[nodiscard]] virtual double points_quality(const PointsObservation& points) const = 0;
  /// What is reported on top of the filter's covariance; nothing where nobody measured it.
  [[nodiscard]] virtual PlaneVariance plane(const PlaneContext& /*context*/) const { return {}; }
  /// 1-sigma of what no frame can tell of ln scale, because it is the same in all frames of a drive.
  [[nodiscard]] virtual double ln_scale_bias_std() const { return 0.0; }
};

/// Set by hand: pixel noise plus a floor for what pixel noise does not explain, pose error, heave
/// and road shape. `ground.covariance = "fixed"`, and what trained models are held against.
class FloorCovariance final : public CueCovariance {
 public:
  [[nodiscard]] Eigen::Matrix3d dense(const DenseObservation& dense,
                                      const CueContext& context) const override;
  [[nodiscard]] double points(const PointsObservation& points,
                              const CueContext& context) const override;
  [[nodiscard]] double travel(const Travel& travel, const CueContext& context) const override;
  [[nodiscard]] double dense_repetition(const CueContext& context) const override;
  [[nodiscard]] double points_repetition(const CueContext& context) const override;
  [[nodiscard]] double objects_repetition() const override;
  [[nodiscard]] RoadBend road_bend() const override;
  [[nodiscard]] double dense_quality(const DenseObservation& dense) const override;
  [[nodiscard]] double points_quality(const PointsObservation& points) const override;
};

/// How much longer than on the straight a cue's error lasts in a turn; 1 on the straight.
[[nodiscard]] double turn_repetition(const CueContext& context);

/// Takes the variance of ln h, the normal known, `repetition` times; what follows from the tilt stays.
[[nodiscard]] Eigen::Matrix3d with_height_repeated(const Eigen::Matrix3d& cov, double repetition);

/// (n1, n3, ln h) of a plane q = n/h.
[[nodiscard]] Eigen::Vector3d state_of_plane(const Eigen::Vector3d& q);

/// Information of (n1, n3, ln h) in the dense cue by pixel noise alone, never singular. `noise_ratio`: standard
/// deviation of the residuals over what they were taken for.
[[nodiscard]] Eigen::Matrix3d state_information(const DenseObservation& dense,
                                                double noise_ratio = 1.0);
/// d(ln h given the normal) / d(n1, n3).
[[nodiscard]] Eigen::RowVector2d given_slope(const Eigen::Matrix3d& state_information);

}  // namespace plumb
