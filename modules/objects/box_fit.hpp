/// Fits a 3D box on the road to an image box: the most probable state under a Gaussian prior.
///
/// Source   Song and Chandraker, CVPR 2014, section 3: pitch and roll from the plane, prior on
///          length to width, reprojection to the tracked 2D box.
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/camera_model.hpp"
#include "modules/detections/road_plane.hpp"
#include "modules/objects/cuboid.hpp"

namespace plumb {

/// State and covariance; prior in, posterior out.
struct StateEstimate {
  StateVector x = StateVector::Zero();
  StateMatrix P = StateMatrix::Zero();
};

struct MeasuredBox {
  Eigen::Vector4d edges_px = Eigen::Vector4d::Zero();  ///< left, top, right, lower
  Eigen::Vector4d var_px2 = Eigen::Vector4d::Ones();   ///< per edge
  /// The image ends here, the object may go on: the edge counts only against solutions inside it.
  std::array<bool, 4> cut{};
};

/// How far inside its outline an object touches the road.
struct Contact {
  double inset_m = 0.0;
  double inset_std_m = 0.0;
};

struct BoxFitResult {
  bool ok = false;
  StateEstimate estimate;
  double chi2 = 0.0;     ///< of the box against the prior, before anything loses weight
  double log_det = 0.0;  ///< of the covariance that chi2 is measured with [ln px^8]
  double cost = 0.0;  ///< the same about the solution, with the weights: compares fits of one box
};

/// Iterated Kalman update. Edges that disagree with the rest lose weight (Student's t). Not ok when
/// the object cannot be seen from here or the result is not finite; the prior then stands.
[[nodiscard]] BoxFitResult fit_box(const CameraModel& camera, const RoadPlane& plane,
                                   const Contact& contact, const MeasuredBox& box,
                                   const StateEstimate& prior);

}  // namespace plumb
