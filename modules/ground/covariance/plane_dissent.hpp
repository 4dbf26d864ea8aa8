/// How far what looks at the road has lately disagreed with the fused plane.
///
/// Where the road bends, the dense cue sees the road ahead and the direction of travel the road under the car; the
/// fused normal lies between them, and is wrong by about as much as they are apart.
///
/// Units  of the state (n1, n3); means over the last camera heights of way.
#pragma once

#include <Eigen/Core>

#include "modules/ground/covariance/cue_covariance.hpp"
#include "modules/ground/covariance/ground_sight.hpp"

namespace plumb {

class PlaneDissent {
 public:
  /// Takes a frame whose cues are in `state`. @pre sight.searched
  void add(const GroundSight& sight, const Eigen::Vector3d& state);
  void forget() { *this = PlaneDissent(); }

  [[nodiscard]] const PlaneContext& context() const { return context_; }

 private:
  PlaneContext context_;
  double dense_n3_mean_ = 0.0;
  bool dense_seen_ = false;
  bool travel_seen_ = false;
};

}  // namespace plumb
