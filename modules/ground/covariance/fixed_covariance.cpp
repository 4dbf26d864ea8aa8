#include "modules/ground/covariance/fixed_covariance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

// Residuals of neighbouring pixels are correlated: standard deviations grow by this factor.
constexpr double kPixelCorrelation = 3.0;
// In a turn, residual calibration errors bend the optical flow, which looks like a tilt with a
// matching height: the direction that pixels determine worst. Grows with the path's curvature.
constexpr double kTurnGrowth = 20.0;
constexpr double kDenseTiltFloorStd = 0.4 * kDegree;
constexpr double kDenseLnHeightFloorStd = 0.03;
constexpr double kPointsLnHeightStd = 0.04;
// Number of inliers at which the points' variance is twice its floor.
constexpr double kPointsHalfTrust = 10.0;
constexpr double kChordStd = 0.15 * kDegree;
// A parabola seen between 5.5 and 20 m ahead, against the last few metres under the car.
constexpr RoadBend kRoadBend{0.3 * kDegree, 8.0, 2.5};
// Below this correlation, noise dominates the images or part of them shows no road: variances grow
// with the fourth power of the ratio.
constexpr double kFullCorrelation = 0.8;
// Images nearer to each other than this show the same road, with the same errors.
constexpr double kIndependentStepRatio = 0.6;
// Errors of the boxes stay correlated from image to image, as the objects' heights and their road
// do.
constexpr double kObjectsCorrelatedImages = 10.0;

double images_of_the_same_road(const CueContext& context) {
  return std::max(1.0, kIndependentStepRatio / std::max(1e-6, context.step_ratio)) *
         turn_correlation(context);
}

}  // namespace

Eigen::Matrix3d FixedCovariance::dense(const DenseMeasurement& dense,
                                       const CueContext& context) const {
  const double correlation = kPixelCorrelation * (1.0 + kTurnGrowth * context.turn_ratio);
  Eigen::Matrix3d cov = state_information(dense, correlation).inverse();
  cov(0, 0) += kDenseTiltFloorStd * kDenseTiltFloorStd;
  cov(1, 1) += kDenseTiltFloorStd * kDenseTiltFloorStd;
  cov(2, 2) += kDenseLnHeightFloorStd * kDenseLnHeightFloorStd;
  const double doubt = kFullCorrelation / std::clamp(dense.ncc, 0.1, kFullCorrelation);
  return doubt * doubt * doubt * doubt * cov;
}

double FixedCovariance::points(const PointsMeasurement& points,
                               const CueContext& /*context*/) const {
  return kPointsLnHeightStd * kPointsLnHeightStd * (1.0 + kPointsHalfTrust / points.num_inliers);
}

double FixedCovariance::chord(const Chord& /*chord*/, const CueContext& /*context*/) const {
  return kChordStd * kChordStd;
}

double FixedCovariance::dense_correlated_images(const CueContext& context) const {
  return images_of_the_same_road(context);
}

double FixedCovariance::points_correlated_images(const CueContext& context) const {
  return images_of_the_same_road(context);
}

double FixedCovariance::objects_correlated_images() const { return kObjectsCorrelatedImages; }

RoadBend FixedCovariance::road_bend() const { return kRoadBend; }

double FixedCovariance::dense_quality(const DenseMeasurement& dense) const {
  return dense.ok ? std::clamp(dense.ncc, 0.0, 1.0) : 0.0;
}

double FixedCovariance::points_quality(const PointsMeasurement& points) const {
  if (!points.ok) return 0.0;
  return static_cast<double>(points.num_inliers) / (points.num_inliers + kPointsHalfTrust);
}

}  // namespace plumb
