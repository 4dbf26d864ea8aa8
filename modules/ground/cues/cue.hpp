/// The one interface of all cues: a cue looks at a frame, with what is known of the plane before,
/// and returns one observation of the plane.
///
/// The estimator runs every cue of kCueTable in order, hands each the prior, fuses the observations
/// and reports them. docs/add_a_cue.md says how to add a cue.
///
/// Frames:
///   cam of the newest image: x right, y down, z forward; the normal points down.
/// Units:
///   [vo].
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>

#include "core/pyramid.hpp"
#include "modules/ground/covariance/cue_covariance.hpp"
#include "modules/ground/covariance/height_measurement.hpp"
#include "modules/ground/cues/road_pixels.hpp"
#include "modules/ground/filter/observation.hpp"
#include "modules/ground/types/ground_types.hpp"

namespace plumb {

/// What one frame offers to the cues.
struct CueFrame {
  const VoOutput* vo = nullptr;    ///< never null
  const Pyramid* image = nullptr;  ///< newest image; null when it did not arrive
  Chord chord;
  std::span<const ObjectsMeasurement> objects;
};

/// What is known of the plane before the cues of a frame measure it.
struct FramePrior {
  bool predicted = false;   ///< the filter had started and was predicted to this image
  bool converged = false;   ///< PlaneFilter::converged()
  bool measurable = false;  ///< the chord is long enough for a plane to be measured
  Eigen::Vector3d normal_cam = Eigen::Vector3d::UnitY();  ///< expected
  double height = 0.0;                                    ///< expected [vo]; 0: not known
  double ln_height_var = 0.0;                             ///< of the filter; 0: not started
  double ln_height_std = std::numeric_limits<double>::infinity();
  CueContext context;
  RoadShape road;
};

/// What a cue returns about one frame.
struct Observation {
  CueReport report;        ///< status and values, for GROUND_PLANE
  PlaneObservation plane;  ///< for the filter; report.status kUsed only
  /// ln height over a road with the prior's normal, when the cue is certain enough to start the
  /// filter; else NaN.
  double start_ln_height = kNan;
  /// The prior for the cues after this one. A cue that finds the road before the filter has
  /// converged passes on the height that it found; all others return the prior that they were
  /// given.
  FramePrior prior;
};

/// @return an observation that says that there was nothing to measure
[[nodiscard]] inline Observation nothing_observed(const FramePrior& prior) {
  Observation observation;
  observation.prior = prior;
  return observation;
}

class Cue {
 public:
  Cue() = default;
  virtual ~Cue() = default;
  Cue(const Cue&) = delete;
  Cue& operator=(const Cue&) = delete;

  /// Measures one frame. Allocates nothing; deterministic in the frames so far.
  [[nodiscard]] virtual Observation measure(const CueFrame& frame, const FramePrior& prior) = 0;

  /// The height that the last measurement gives over the road `plane` = (n1, n3, ln h), of which
  /// only the normal counts. @pre the last status was kUsed and kCueTable says measures_height
  [[nodiscard]] virtual HeightMeasurement height_over(const Eigen::Vector3d& /*plane*/) const {
    return {};
  }
};

}  // namespace plumb
