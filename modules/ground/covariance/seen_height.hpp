/// From what one frame's cues saw ahead: the height there, over a road whose normal is known.
///
/// Units  [vo]; state (n1, n3, ln h), slope d(ln h) / d(n1, n3).
#pragma once

#include <Eigen/Core>

#include "modules/ground/covariance/cue_covariance.hpp"
#include "modules/ground/covariance/ground_sight.hpp"

namespace plumb {

struct SeenHeight {
  double ln_height = 0.0;
  double var = 0.0;  ///< by the cues' own noise
  Eigen::RowVector2d slope = Eigen::RowVector2d::Zero();
};

/// Height of the plane that fits the dense cue best when its normal is `n`.
[[nodiscard]] double height_given_normal(const DenseObservation& dense, const Eigen::Vector3d& n);

/// Mean of the used cues' heights, weighted. @pre one of them was used; `state` gives the normal
[[nodiscard]] SeenHeight see_height(const GroundSight& sight, const CueCovariance& covariance,
                                    const Eigen::Vector3d& state);

}  // namespace plumb
