/// What training found out about the cues: how far each one's error scatters, by what is known in the frame.
///
/// A cue's variance is exp(ln_var + sum of slope times feature), kept between two bounds. Features are zero in a usual
/// frame (straight on, one step of half a camera height, sharp agreement of the images), so ln_var is the usual frame's.
///
/// Units  of the state (n1, n3, ln h); the published method's in metres (paper_model.hpp).
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "modules/ground/covariance/paper_model.hpp"
#include "modules/ground/filter/road_bend.hpp"

namespace plumb {

inline constexpr int kGroundModelVersion = 4;
inline constexpr std::size_t kNumCueFeatures = 4;
using CueFeatures = std::array<double, kNumCueFeatures>;

/// Which number of CueFeatures is what.
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
  kPlaneTravel = 1,
  kPlaneTurn = 2,
  kPlaneStep = 3
};

/// Grows with the path's curvature times camera height, from 0 when straight on: calibration's leftovers bend the flow.
[[nodiscard]] double turn_feature(double turn_ratio);
/// Above 0 for steps shorter than half a camera height.
[[nodiscard]] double step_feature(double step_ratio);
/// `pixel_var`: of the component, by pixel noise alone.
[[nodiscard]] CueFeatures dense_features(double pixel_var, double ncc, double turn_ratio,
                                         double step_ratio);
[[nodiscard]] CueFeatures points_features(double num_inliers, double spread, double turn_ratio,
                                          double step_ratio);
/// Turn and step only.
[[nodiscard]] CueFeatures travel_features(double turn_ratio, double step_ratio);
/// Of the reported plane: squares of the angles by which dense cue and direction of travel leave the fused normal.
[[nodiscard]] CueFeatures plane_features(double dense_square, double travel_square,
                                         double turn_ratio, double step_ratio);

struct LogVariance {
  double ln_var = 0.0;
  CueFeatures slopes{};
  double low_std = 0.0;
  double high_std = 0.0;

  [[nodiscard]] double of(const CueFeatures& features) const;
};

/// Where the numbers come from.
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
  LogVariance travel;        ///< of n . direction, n of the road under the car
  RoadBend bend;
  /// Way over which a cue's errors of the height stay alike, in camera heights.
  double dense_memory_ratio = 0.0;
  double points_memory_ratio = 0.0;
  double objects_repetition = 1.0;  ///< images over which the objects' error of n3 stays alike
  /// What is reported on top of the filter's own variances.
  LogVariance plane_pitch;
  LogVariance plane_roll;
  LogVariance plane_height;
  double ln_scale_bias_std = 0.0;  ///< what no frame can tell: it is the same in a whole drive
  LinearVariance objects_n3;  ///< of n3 out of detected objects, by the variance of the boxes alone
  PaperModel paper;

  /// Numbers only, under the names of the file's sections; origin is the loader's.
  template <typename Model, typename Visit>
  static void visit(Model& m, Visit&& field);
};

/// The numbers of config/ground_model.toml, as they were when the program was built. Without its origin.
[[nodiscard]] GroundModel built_in_ground_model();

}  // namespace plumb

#include "modules/ground/covariance/ground_model_fields.hpp"
