/// The object cue of the paper: the pitch from each detected object alone, and how accurately the
/// detector has placed its box.
///
/// Pitch (9): n3 at which the object is as tall as its class, with h calibrated and n1 = 0.
/// Accuracy (10): the mixture of Gaussians that the scores of the boxes from before suppression
/// form. The Gaussian nearest to the box has the covariance that gives a_d.
///
/// Frames:
///   cam of the image in which the objects were detected.
/// Memory:
///   One mixture fit in place.
#pragma once

#include <cstddef>

#include "core/camera_model.hpp"
#include "core/fixed_vector.hpp"
#include "modules/detections/detection.hpp"
#include "modules/detections/detections_config.hpp"
#include "modules/ground/cues/candidate_mixture.hpp"

namespace plumb {

struct PaperObject {
  std::size_t index = 0;         ///< in the frame's detections
  double n3 = 0.0;               ///< by (9)
  double confidence_px2 = 0.0;   ///< a_d; NaN when there are too few candidates for (10)
  MixtureComponent component{};  ///< that a_d is of; only where a_d is a number
};

using PaperObjects = FixedVector<PaperObject, kMaxDetections>;

class PaperObjectsCue {
 public:
  /// @param pitch_rad  the calibrated one, nose down positive: decides which boxes are on the road
  PaperObjectsCue(const DetectionsConfig& config, const CameraModel& camera, double pitch_rad);

  /// Measures every object that is whole, visible and on the road. The result is valid until the
  /// next call. @pre height_m > 0, calibrated
  const PaperObjects& measure(const DetectionFrame& frame, double height_m);

 private:
  /// (10) for one object and those whose boxes overlap with it; false without enough candidates.
  bool fit(const DetectionFrame& frame, std::size_t index);

  DetectionsConfig config_;
  CameraModel camera_;
  double pitch_rad_;
  CandidateMixture mixture_;
  PaperObjects objects_;
};

}  // namespace plumb
