/// Fits a 3D box on the road to an image box. The result is the state of maximum posterior
/// probability under a Gaussian prior.
///
/// Frames:
///   ground as in cuboid.hpp; img as in detection.hpp.
/// Source:
///   Song and Chandraker, CVPR 2014, section 3: pitch and roll from the plane, prior on length to
///   width, reprojection to the tracked 2D box.
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/camera_model.hpp"
#include "modules/detections/road_plane.hpp"
#include "modules/objects/cuboid.hpp"

namespace plumb {

/// A state and its covariance.
struct StateEstimate {
  StateVector x = StateVector::Zero();
  StateMatrix P = StateMatrix::Zero();
};

struct MeasuredBox {
  Eigen::Vector4d edges_px = Eigen::Vector4d::Zero();  ///< left, top, right, bottom
  Eigen::Vector4d var_px2 = Eigen::Vector4d::Ones();   ///< variance of each edge
  /// True where the image cuts the object. Such an edge is a bound: it has an effect only on
  /// solutions that end inside it.
  std::array<bool, 4> cut{};
};

/// Distance inside the outline of an object at which it touches the road,
/// and its standard deviation.
struct Contact {
  double inset_m = 0.0;
  double inset_std_m = 0.0;
};

struct BoxFitResult {
  bool ok = false;
  StateEstimate estimate;
  /// Squared Mahalanobis distance of the box from the prediction of the prior,
  /// without robust weights.
  double chi2 = 0.0;
  double log_det = 0.0;  ///< [ln px^8] log determinant of the covariance in chi2
  /// Squared Mahalanobis distance at the solution with robust weights.
  /// It compares the fits of one box.
  double cost = 0.0;
};

/// Performs an iterated Kalman update in which outlying edges get less weight (Student's t). The
/// result is not ok when the object is not in front of the camera or the state is not finite.
[[nodiscard]] BoxFitResult fit_box(const CameraModel& camera, const RoadPlane& plane,
                                   const Contact& contact, const MeasuredBox& box,
                                   const StateEstimate& prior);

}  // namespace plumb
