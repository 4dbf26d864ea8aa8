/// Cue residual statistics: how far the cues have lately disagreed with the fused plane.
///
/// Where the road bends, the dense cue measures the road ahead and the direction of translation
/// follows the road under the car. The fused normal lies between them, and its error is about as
/// large as their difference.
///
/// Units:
///   Those of the state (n1, n3), as means over the last camera heights travelled.
#pragma once

#include <Eigen/Core>

#include "modules/ground/covariance/cue_covariance.hpp"

namespace plumb {

/// What a frame shows of its cues' residuals.
struct ResidualFrame {
  CueContext context;
  Eigen::Vector3d chord_direction = Eigen::Vector3d::UnitZ();
  const DenseMeasurement* dense = nullptr;  ///< null when the filter did not use the dense cue
};

class ResidualStatistics {
 public:
  /// Takes a frame whose cues are fused in `plane` = (n1, n3, ln h).
  void add(const ResidualFrame& frame, const Eigen::Vector3d& plane);
  void reset() { *this = ResidualStatistics(); }

  [[nodiscard]] const PlaneContext& context() const { return context_; }

 private:
  PlaneContext context_;
  double dense_n3_mean_ = 0.0;
  bool dense_seen_ = false;
  bool chord_seen_ = false;
};

}  // namespace plumb
