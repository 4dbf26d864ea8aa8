/// Cue diagnostics: everything that went into one frame's fusion, for training, tests and displays.
///
/// Frames:
///   cam of the newest image.
/// Units:
///   [vo]; states are (n1, n3, ln h).
#pragma once

#include <Eigen/Core>

#include "modules/ground/covariance/cue_covariance.hpp"
#include "modules/ground/types/ground_types.hpp"

namespace plumb {

struct CueDiagnostics {
  bool measurable = false;  ///< the chord was long enough for the cues to look at the frame
  Chord chord;
  CueContext context;
  DenseMeasurement dense;
  PointsMeasurement points;
  CueReports cues{};  ///< as reported: status, innovation and test ratio of every cue

  bool filter_started = false;                      ///< state and cov are valid
  Eigen::Vector3d state = Eigen::Vector3d::Zero();  ///< of the road ahead, after the fusion
  Eigen::Matrix3d cov = Eigen::Matrix3d::Zero();
  PlaneContext plane_context;
  PlaneVariance plane_added;       ///< variance that was reported on top of `cov`
  double ln_scale_bias_var = 0.0;  ///< variance that was reported on top of the scale's
};

}  // namespace plumb
