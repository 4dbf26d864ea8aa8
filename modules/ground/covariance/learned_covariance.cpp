#include "modules/ground/covariance/learned_covariance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "modules/ground/covariance/fixed_covariance.hpp"

namespace plumb {
namespace {

constexpr double kSmallestStepRatio = 1e-3;
constexpr double kMostCorrelatedImages = 1000.0;

}  // namespace

double correlated_images(double correlation_length_ratio, double step_ratio) {
  const double x =
      0.5 * std::max(step_ratio, kSmallestStepRatio) / std::max(correlation_length_ratio, 1e-6);
  // (1 + r) / (1 - r) with r = e^(-2 x)
  return std::min(1.0 / std::tanh(x), kMostCorrelatedImages);
}

Eigen::Matrix3d LearnedCovariance::dense(const DenseMeasurement& dense,
                                         const CueContext& context) const {
  const Eigen::Matrix3d information = state_information(dense);
  const Eigen::Matrix3d pixel = information.inverse();
  const auto variance = [&](const LogVariance& model, double pixel_var) {
    return model.of(dense_features(pixel_var, dense.ncc, context.turn_ratio, context.step_ratio));
  };
  const Eigen::Vector2d tilt(variance(model_.dense_n1, pixel(0, 0)),
                             variance(model_.dense_n3, pixel(1, 1)));
  const Eigen::RowVector2d slope = given_slope(information);
  Eigen::Matrix3d cov = Eigen::Matrix3d::Zero();
  cov(0, 0) = tilt(0);
  cov(1, 1) = tilt(1);
  cov.block<1, 2>(2, 0) = slope.cwiseProduct(tilt.transpose());
  cov.block<2, 1>(0, 2) = cov.block<1, 2>(2, 0).transpose();
  cov(2, 2) =
      variance(model_.dense_height, 1.0 / information(2, 2)) + cov.block<1, 2>(2, 0).dot(slope);
  return cov;
}

double LearnedCovariance::points(const PointsMeasurement& points, const CueContext& context) const {
  return model_.points.of(points_features(points.num_inliers, points.ln_height_std,
                                          context.turn_ratio, context.step_ratio));
}

double LearnedCovariance::chord(const Chord& /*chord*/, const CueContext& context) const {
  return model_.chord.of(chord_features(context.turn_ratio, context.step_ratio));
}

PlaneVariance LearnedCovariance::plane(const PlaneContext& context) const {
  const auto [turn_ratio, step_ratio] = context.cue;
  const CueFeatures forward =
      plane_features(context.dense_n3_square, context.chord_square, turn_ratio, step_ratio);
  const CueFeatures sideways = plane_features(context.dense_n1_square, 0.0, turn_ratio, step_ratio);
  return {model_.plane_pitch.of(forward), model_.plane_roll.of(sideways),
          model_.plane_height.of(forward)};
}

double LearnedCovariance::dense_correlated_images(const CueContext& context) const {
  return turn_correlation(context) *
         correlated_images(model_.dense_correlation_length_ratio, context.step_ratio);
}

double LearnedCovariance::points_correlated_images(const CueContext& context) const {
  return turn_correlation(context) *
         correlated_images(model_.points_correlation_length_ratio, context.step_ratio);
}

double LearnedCovariance::dense_quality(const DenseMeasurement& dense) const {
  return FixedCovariance().dense_quality(dense);
}

double LearnedCovariance::points_quality(const PointsMeasurement& points) const {
  return FixedCovariance().points_quality(points);
}

}  // namespace plumb
