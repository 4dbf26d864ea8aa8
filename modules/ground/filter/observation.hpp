/// What the plane filter fuses: a measured value z, its covariance R, and the measurement function
/// that predicts z from the plane.
///
/// Every cue, the direction of translation and the prior of a level car take this one form, so the
/// filter has one update for all of them. The function is linearised at the filter's newest state,
/// which earlier observations of the same frame have already moved.
///
/// Units:
///   The plane is x = (n1, n3, ln h) with h in [vo].
#pragma once

#include <Eigen/Core>

namespace plumb {

/// An observation's innovation y = z - h(x) and Jacobian H = dh/dx at a plane x.
struct Linearisation {
  int num_rows = 0;  ///< 1 or 3; 0 where the observation is undefined at this plane
  Eigen::Vector3d innovation = Eigen::Vector3d::Zero();
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();  ///< its first num_rows rows
};

/// Linearises an observation of `value` at `plane` = (n1, n3, ln h).
using MeasurementFunction = Linearisation (*)(const Eigen::Vector3d& value,
                                              const Eigen::Vector3d& plane);

/// Which of the filter's two planes an observation sees (plane_filter.hpp).
enum class RoadPart { kUnderCar, kAhead };

struct PlaneObservation {
  MeasurementFunction function = nullptr;           ///< null: nothing to fuse
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< as `function` takes it
  Eigen::Matrix3d cov = Eigen::Matrix3d::Zero();    ///< R, its first num_rows rows and columns
  RoadPart road = RoadPart::kAhead;
  /// Above 0: the value has the slowly changing error of the road's speed, of this variance, in
  /// addition. One row only.
  double speed_error_var = 0.0;
  bool gated = true;        ///< robust: an innovation beyond the gate is rejected
  int first_component = 0;  ///< of (n1, n3, ln h) that the first row's innovation is reported as
};

/// z = (n1, n3, ln h): the whole plane. H is the identity.
[[nodiscard]] Linearisation observe_plane(const Eigen::Vector3d& state,
                                          const Eigen::Vector3d& plane);

/// ln(n . c) = ln h: the road passes through the point c = `centre`. With ln(n . c) as z, which
/// depends on the normal, H = (-(c / (n . c))^T dn/d(n1, n3), 1). Undefined for n . c <= 0.
[[nodiscard]] Linearisation observe_point(const Eigen::Vector3d& centre,
                                          const Eigen::Vector3d& plane);

/// z = ln h = value(0): the height alone.
[[nodiscard]] Linearisation observe_height(const Eigen::Vector3d& value,
                                           const Eigen::Vector3d& plane);

/// z = n3 = value(0): the pitch alone.
[[nodiscard]] Linearisation observe_pitch(const Eigen::Vector3d& value,
                                          const Eigen::Vector3d& plane);

/// 0 = n . d: the camera translates along `direction`, parallel to the road.
[[nodiscard]] Linearisation observe_direction(const Eigen::Vector3d& direction,
                                              const Eigen::Vector3d& plane);

/// 0 = n1: the car stands level on its road.
[[nodiscard]] Linearisation observe_level(const Eigen::Vector3d& unused,
                                          const Eigen::Vector3d& plane);

}  // namespace plumb
