#include "modules/ground/cues/objects_cue.hpp"

namespace plumb {

Observation ObjectsCue::measure(const CueFrame& frame, const FramePrior& prior) {
  Observation out = nothing_observed(prior);
  if (frame.objects.empty() || !prior.predicted) return out;
  const ObjectsMeasurement& objects = frame.objects.front();
  out.report.status = CueStatus::kUsed;
  out.report.n3 = objects.n3;
  out.report.n3_var = objects.n3_var;
  out.report.quality = objects.quality;
  out.report.features[0] = objects.confidence;
  out.report.num_features = 1;
  out.plane.function = observe_pitch;
  out.plane.value(0) = objects.n3;
  out.plane.cov(0, 0) = covariance_.objects_correlated_images() * objects.n3_var;
  out.plane.first_component = 1;
  return out;
}

}  // namespace plumb
