/// Objects cue: the camera's pitch from detected objects (objects_queue.hpp), as an observation of
/// n3.
///
/// It is not fused at standstill: the same boxes again and again would claim a certainty that they
/// do not have.
///
/// Memory:
///   Nothing is allocated.
#pragma once

#include "modules/ground/cues/cue.hpp"

namespace plumb {

class ObjectsCue final : public Cue {
 public:
  /// `covariance` must outlive the cue.
  explicit ObjectsCue(const CueCovariance& covariance) : covariance_(covariance) {}

  [[nodiscard]] Observation measure(const CueFrame& frame, const FramePrior& prior) override;

 private:
  const CueCovariance& covariance_;
};

}  // namespace plumb
