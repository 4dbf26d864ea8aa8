#include "modules/ground/covariance/cue_covariance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "modules/ground/filter/plane_filter.hpp"

namespace plumb {
namespace {

// Residuals of neighbouring pixels are correlated: standard deviations grow by this.
constexpr double kPixelCorrelation = 3.0;
// In a turn, what calibration leaves over bends the flow and looks like a tilt with a matching height: exactly the
// direction that pixels tell worst. Grows with the path's curvature.
constexpr double kTurnGrowth = 20.0;
// A road that shows no texture in one direction still has a variance there.
constexpr double kLeastInformation = 1e-3;
constexpr double kDenseTiltFloorStd = 0.4 * kDegree;
constexpr double kDenseLnHeightFloorStd = 0.03;
constexpr double kPointsLnHeightStd = 0.04;
constexpr double kPointsHalfTrust =
    10.0;  // inliers at which the variance has halved towards its floor
constexpr double kTravelStd = 0.15 * kDegree;
// A parabola seen between 5.5 and 20 m, against the car's last few metres.
constexpr RoadBend kRoadBend{0.3 * kDegree, 8.0, 2.5};
// Below this correlation noise rules the picture, or part of it is not road: variances grow with its fourth power.
constexpr double kSureCorrelation = 0.8;
// Images nearer together than this see the same road again; their errors are the same errors.
constexpr double kIndependentStepRatio = 0.6;

// Within one turn the road's crossfall, the car's lean and what calibration leaves over keep their sign: its images are
// one sight with one error. VO's own scale is the better witness there. Per unit of the path's curvature.
constexpr double kTurnRepetition = 40.0;

// Boxes err alike from image to image, as the cars' heights and the road under them do.
constexpr double kObjectsRepetition = 10.0;

/// How many images share one independent view of the road.
double repetition(const CueContext& context) {
  return std::max(1.0, kIndependentStepRatio / std::max(1e-6, context.step_ratio)) *
         turn_repetition(context);
}

}  // namespace

double turn_repetition(const CueContext& context) {
  const double growth = 1.0 + kTurnRepetition * context.turn_ratio;
  return growth * growth;
}

Eigen::Matrix3d with_height_repeated(const Eigen::Matrix3d& cov, double repetition) {
  const double given_var = 1.0 / cov.inverse()(2, 2);
  Eigen::Matrix3d repeated = cov;
  repeated(2, 2) += (repetition - 1.0) * given_var;
  return repeated;
}

Eigen::Vector3d state_of_plane(const Eigen::Vector3d& q) {
  const double norm = q.norm();
  return {q.x() / norm, q.z() / norm, -std::log(norm)};
}

Eigen::Matrix3d state_information(const DenseObservation& dense, double noise_ratio) {
  const Eigen::Matrix3d J = plane_jacobian(state_of_plane(dense.q));
  return J.transpose() * dense.information * J / (noise_ratio * noise_ratio) +
         kLeastInformation * Eigen::Matrix3d::Identity();
}

Eigen::RowVector2d given_slope(const Eigen::Matrix3d& state_information) {
  return -state_information.block<1, 2>(2, 0) / state_information(2, 2);
}

Eigen::Matrix3d FloorCovariance::dense(const DenseObservation& dense,
                                       const CueContext& context) const {
  const double correlation = kPixelCorrelation * (1.0 + kTurnGrowth * context.turn_ratio);
  Eigen::Matrix3d cov = state_information(dense, correlation).inverse();
  cov(0, 0) += kDenseTiltFloorStd * kDenseTiltFloorStd;
  cov(1, 1) += kDenseTiltFloorStd * kDenseTiltFloorStd;
  cov(2, 2) += kDenseLnHeightFloorStd * kDenseLnHeightFloorStd;
  const double doubt = kSureCorrelation / std::clamp(dense.ncc, 0.1, kSureCorrelation);
  return doubt * doubt * doubt * doubt * cov;
}

double FloorCovariance::points(const PointsObservation& points,
                               const CueContext& /*context*/) const {
  return kPointsLnHeightStd * kPointsLnHeightStd * (1.0 + kPointsHalfTrust / points.num_inliers);
}

double FloorCovariance::travel(const Travel& /*travel*/, const CueContext& /*context*/) const {
  return kTravelStd * kTravelStd;
}

double FloorCovariance::dense_repetition(const CueContext& context) const {
  return repetition(context);
}

double FloorCovariance::points_repetition(const CueContext& context) const {
  return repetition(context);
}

double FloorCovariance::objects_repetition() const { return kObjectsRepetition; }

RoadBend FloorCovariance::road_bend() const { return kRoadBend; }

double FloorCovariance::dense_quality(const DenseObservation& dense) const {
  return dense.ok ? std::clamp(dense.ncc, 0.0, 1.0) : 0.0;
}

double FloorCovariance::points_quality(const PointsObservation& points) const {
  if (!points.ok) return 0.0;
  return static_cast<double>(points.num_inliers) / (points.num_inliers + kPointsHalfTrust);
}

}  // namespace plumb
