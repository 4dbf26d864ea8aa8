/// The trained model of the cues: it predicts the variance of each cue's error from features of the
/// frame.
///
/// A variance is exp(ln_var + sum of slope times feature), kept between two bounds. All features
/// are zero in a usual frame (straight on, one step of half a camera height, images that agree
/// well), so ln_var belongs to the usual frame.
///
/// Units:
///   Those of the state (n1, n3, ln h).
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "modules/ground/filter/road_bend.hpp"
#include "modules/ground/types/linear_variance.hpp"

namespace plumb {

inline constexpr int kGroundModelVersion = 4;
inline constexpr std::size_t kNumCueFeatures = 4;
using CueFeatures = std::array<double, kNumCueFeatures>;

/// Indices into CueFeatures.
enum DenseFeature : std::size_t {
  kDensePixel = 0,
  kDenseDoubt = 1,
  kDenseTurn = 2,
  kDenseStep = 3
};
enum PointsFeature : std::size_t {
  kPointsFew = 0,
  kPointsSpread = 1,
  kPointsTurn = 2,
  kPointsStep = 3
};
enum PlaneFeature : std::size_t {
  kPlaneDense = 0,
  kPlaneChord = 1,
  kPlaneTurn = 2,
  kPlaneStep = 3
};

/// Zero when straight on, and growing with the path's curvature times camera height: residual
/// calibration errors bend the optical flow in turns.
[[nodiscard]] double turn_feature(double turn_ratio);
/// Positive for steps shorter than half a camera height.
[[nodiscard]] double step_feature(double step_ratio);
/// `pixel_var`: variance of the component from pixel noise alone.
[[nodiscard]] CueFeatures dense_features(double pixel_var, double ncc, double turn_ratio,
                                         double step_ratio);
[[nodiscard]] CueFeatures points_features(double num_inliers, double spread, double turn_ratio,
                                          double step_ratio);
/// Only turn and step are used.
[[nodiscard]] CueFeatures chord_features(double turn_ratio, double step_ratio);
/// Features of the reported plane. The squares are those of PlaneContext: angles between the dense
/// cue, or the direction of translation, and the fused plane.
[[nodiscard]] CueFeatures plane_features(double dense_square, double chord_square,
                                         double turn_ratio, double step_ratio);

struct LogVariance {
  double ln_var = 0.0;
  CueFeatures slopes{};
  double low_std = 0.0;
  double high_std = 0.0;

  [[nodiscard]] double of(const CueFeatures& features) const;
};

/// Which drives and command the numbers come from.
struct ModelOrigin {
  std::string drives;
  std::string command;
  std::string date;
};

struct GroundModel {
  ModelOrigin origin;
  LogVariance dense_n1;
  LogVariance dense_n3;
  LogVariance dense_height;  ///< of ln h once the normal is known
  LogVariance points;        ///< of ln h once the normal is known
  LogVariance chord;         ///< of n . direction, n of the road under the car
  RoadBend bend;
  /// Distance travelled, in camera heights, over which a cue's errors of the height stay
  /// correlated.
  double dense_correlation_length_ratio = 0.0;
  double points_correlation_length_ratio = 0.0;
  double objects_correlated_images = 1.0;  ///< images that share one error of the objects' n3
  // Variances that are reported on top of the filter's own.
  LogVariance plane_pitch;
  LogVariance plane_roll;
  LogVariance plane_height;
  double ln_scale_bias_std = 0.0;  ///< part of ln scale's error that is the same in a whole drive
  LinearVariance objects_n3;       ///< of n3 from detected objects, by the variance of the boxes

  /// Visits the numbers under the names of the file's sections. `origin` is the loader's.
  template <typename Model, typename Visit>
  static void visit(Model& m, Visit&& field);
};

/// The numbers of config/ground_model.toml as they were when the program was built; no origin.
[[nodiscard]] GroundModel built_in_ground_model();

}  // namespace plumb

#include "modules/ground/covariance/ground_model_fields.hpp"
