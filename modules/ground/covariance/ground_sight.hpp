/// What one frame's cues saw, as the fusion used it: for training, tests and displays.
///
/// Frames  cam of the newest image.  Units  [vo]; state (n1, n3, ln h).
#pragma once

#include <Eigen/Core>

#include "modules/ground/covariance/cue_covariance.hpp"
#include "modules/ground/cues/dense_cue.hpp"
#include "modules/ground/cues/points_cue.hpp"
#include "modules/ground/cues/travel.hpp"
#include "modules/ground/types/ground_types.hpp"

namespace plumb {

struct GroundSight {
  bool searched = false;  ///< the baseline was long enough to look for cues
  Travel travel;
  CueContext context;
  DenseObservation dense;
  PointsObservation points;
  CueStatus dense_status = CueStatus::kAbsent;
  CueStatus points_status = CueStatus::kAbsent;
  ObjectNormal objects;
  CueStatus objects_status = CueStatus::kAbsent;

  bool filter_started = false;                      ///< the two below hold
  Eigen::Vector3d state = Eigen::Vector3d::Zero();  ///< of the filter, this frame's cues in it
  Eigen::Matrix3d cov = Eigen::Matrix3d::Zero();
  PlaneContext plane_context;
  PlaneVariance plane_added;       ///< what was reported on top of `cov`
  double ln_scale_bias_var = 0.0;  ///< the same
};

}  // namespace plumb
