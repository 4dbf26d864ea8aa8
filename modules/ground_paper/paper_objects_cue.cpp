#include "modules/ground_paper/paper_objects_cue.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "modules/detections/box_screen.hpp"
#include "modules/detections/foot_point.hpp"

namespace plumb {
namespace {

// Fewer candidates than this leave all but the prior of the fit undetermined.
constexpr std::size_t kLeastToFit = 6;
constexpr int kFitIterations = 20;

double best_score(const Detection& detection) {
  double best = 0.0;
  for (const Candidate& candidate : detection.candidates) best = std::max(best, candidate.score);
  return best;
}

}  // namespace

PaperObjectsCue::PaperObjectsCue(const DetectionsConfig& config, const CameraModel& camera,
                                 double pitch_rad)
    : config_(config), camera_(camera), pitch_rad_(pitch_rad) {}

const PaperObjects& PaperObjectsCue::measure(const DetectionFrame& frame, double height_m) {
  objects_.clear();
  RoadPlane calibrated{pitch_rad_, 0.0, height_m};
  calibrated.cov(0, 0) = square(config_.pitch_std_rad);
  Verdicts verdicts{};
  screen_boxes(config_, camera_, calibrated, frame, &verdicts);
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    if (verdicts[i] != BoxVerdict::kUsed) continue;
    const Detection& detection = frame.detections[i];
    const Box& box = detection.box;
    const double ratio = config_.height_prior(detection.object_class).mean_m / height_m;
    const auto pitch =
        pitch_from_box(camera_, 0.0, {box.centre_u_px(), box.bottom_px}, box.top_px, ratio);
    if (!pitch) continue;
    PaperObject object{i, std::sin(pitch->pitch_rad), kNan, {}};
    if (fit(frame, i)) {
      object.component = mixture_.component(mixture_.nearest_component(box));
      object.confidence_px2 = placement_confidence_px2(object.component);
    }
    if (!objects_.push_back(object)) break;
  }
  return objects_;
}

bool PaperObjectsCue::fit(const DetectionFrame& frame, std::size_t index) {
  const Detection& detection = frame.detections[index];
  if (detection.candidates.size() < kLeastToFit) return false;
  mixture_.clear();
  const auto add = [this](const Detection& d) {
    if (d.candidates.empty() || !mixture_.add_component(d.box, best_score(d))) return;
    for (const Candidate& c : d.candidates) (void)mixture_.add_sample(c.box, c.score);
  };
  add(detection);
  // An object that shares no pixel with this one has no part in the scores of its candidates.
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    if (i != index && intersection_over_union(frame.detections[i].box, detection.box) > 0.0)
      add(frame.detections[i]);
  }
  return mixture_.num_components() > 0 && mixture_.num_samples() >= kLeastToFit &&
         mixture_.fit(kFitIterations);
}

}  // namespace plumb
