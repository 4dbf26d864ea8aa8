#include "modules/objects/objects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/detections/box_screen.hpp"
#include "modules/objects/object_prior.hpp"

namespace plumb {
namespace {

constexpr double kNearestRange_m = 0.5;
constexpr double kMostRangeRatio = 1.5;  ///< relative to the distance up to which boxes are used
constexpr double kPartlyHidden = 0.25;   ///< share of an edge that makes a box count as hidden

Box box_of(const Eigen::Vector4d& edges_px) {
  return {edges_px(0), edges_px(1), edges_px(2), edges_px(3)};
}

double range_of(const StateEstimate& estimate) { return estimate.x.head<2>().norm(); }

/// Estimates a new object's distance from its size alone, to compare it with tracked objects.
double rough_range_m(const TrackView& view, const Detection& detection) {
  const double height_m = height_prior(view, detection.object_class).mean_m;
  return height_m * view.camera.fy_px / detection.box.height_px();
}

}  // namespace

ObjectTracker::ObjectTracker(const DetectionsConfig& detections, const ObjectsConfig& objects,
                             const CameraModel& camera)
    : detections_(detections), objects_(objects), camera_(camera) {}

const ObjectsOutput& ObjectTracker::update(const ObjectsInput& input) {
  const DetectionFrame& frame = *input.frame;
  const TrackView view{detections_, objects_, camera_, input.plane};
  output_ = {};
  predict(view, input);
  Matches matches;
  match(view, frame, &matches);
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    if (frame.detections[i].score < detections_.min_score) continue;
    std::size_t slot = matches[i];
    if (slot == kNone) slot = slot_for(view, frame.detections[i]);
    if (slot == kNone) {
      ++output_.num_refused;
    } else {
      update_slot(view, input, i, slot);
    }
  }
  end_tracks(frame.capture_us);
  report(view, input);
  return output_;
}

void ObjectTracker::predict(const TrackView& view, const ObjectsInput& input) {
  for (Slot& slot : slots_) {
    if (!slot.in_use) continue;
    slot.seen = false;
    slot.reason = ObjectReason::kNotSeen;
    if (slot.localised) slot.track.predict(view, input.motion);
  }
}

void ObjectTracker::match(const TrackView& view, const DetectionFrame& frame, Matches* matches) {
  matches->fill(kNone);
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    const std::int32_t id = frame.detections[i].track_id;
    for (std::size_t slot = 0; slot < kMaxObjects && id >= 0; ++slot) {
      if (!slots_[slot].in_use || slots_[slot].track_id != id) continue;
      (*matches)[i] = slot;
      slots_[slot].seen = true;
    }
  }
  match_by_overlap(view, frame, matches);
}

void ObjectTracker::match_by_overlap(const TrackView& view, const DetectionFrame& frame,
                                     Matches* matches) {
  for (std::size_t slot = 0; slot < kMaxObjects; ++slot) {
    const bool open = slots_[slot].in_use && slots_[slot].localised && !slots_[slot].seen &&
                      slots_[slot].track_id >= kFirstOwnId;
    const auto seen =
        open ? project_cuboid(camera_, view.plane, slots_[slot].track.estimate().x, 0.0)
             : std::nullopt;
    for (std::size_t i = 0; i < frame.detections.size(); ++i) {
      const Detection& detection = frame.detections[i];
      overlap_[i][slot] = seen && detection.track_id < 0 && detection.score >= detections_.min_score
                              ? intersection_over_union(box_of(seen->edges_px), detection.box)
                              : 0.0;
    }
  }
  // The pair with the largest overlap is matched first.
  // Among equal ones the order of the boxes decides.
  while (true) {
    double best = objects_.least_overlap_ratio;
    std::size_t best_detection = kMaxDetections, best_slot = kNone;
    for (std::size_t i = 0; i < frame.detections.size(); ++i) {
      for (std::size_t slot = 0; slot < kMaxObjects; ++slot) {
        if (overlap_[i][slot] <= best) continue;
        best = overlap_[i][slot];
        best_detection = i;
        best_slot = slot;
      }
    }
    if (best_slot == kNone) return;
    (*matches)[best_detection] = best_slot;
    slots_[best_slot].seen = true;
    overlap_[best_detection].fill(0.0);
    for (auto& row : overlap_) row[best_slot] = 0.0;
  }
}

std::size_t ObjectTracker::slot_for(const TrackView& view, const Detection& detection) {
  std::size_t farthest = kNone;
  double most_m = 0.0;
  for (std::size_t slot = 0; slot < kMaxObjects; ++slot) {
    if (!slots_[slot].in_use) return slot;
    // Objects that were never localised are replaced first.
    const double range_m = slots_[slot].localised ? range_of(slots_[slot].track.estimate())
                                                  : std::numeric_limits<double>::infinity();
    if (range_m <= most_m) continue;
    most_m = range_m;
    farthest = slot;
  }
  if (rough_range_m(view, detection) >= most_m) return kNone;
  ++output_.num_refused;
  slots_[farthest].in_use = false;
  return farthest;
}

void ObjectTracker::update_slot(const TrackView& view, const ObjectsInput& input, std::size_t index,
                                std::size_t slot_index) {
  const DetectionFrame& frame = *input.frame;
  const Detection& detection = frame.detections[index];
  const MeasuredBox box = measured_box(detections_, camera_, frame, index);
  Slot& slot = slots_[slot_index];
  const bool is_new = !slot.in_use;
  if (is_new) {
    slot = {};
    slot.in_use = true;
    slot.track_id = detection.track_id >= 0 ? detection.track_id : next_own_id_++;
    slot.begun_us = frame.capture_us;
  }
  slot.seen = true;
  slot.seen_us = frame.capture_us;
  if (!slot.localised) {
    slot.localised = slot.track.start(view, detection, box);
    slot.reason = slot.localised ? ObjectReason::kNone : ObjectReason::kNoFit;
  } else {
    const bool fits = slot.track.correct(view, detection, box);
    slot.reason = fits ? ObjectReason::kNone : ObjectReason::kMisfit;
  }
  if (slot.reason != ObjectReason::kNone) return;
  const HiddenEdges hidden = hidden_edges(frame, index);
  if (!input.plane_measured) slot.reason = ObjectReason::kCalibratedPlane;
  if (std::max(hidden.lower_ratio, hidden.upper_ratio) > kPartlyHidden) {
    slot.reason = ObjectReason::kHidden;
  }
  if (cut_sides(camera_, detection.box, detections_.border_px).any()) {
    slot.reason = ObjectReason::kCut;
  }
}

void ObjectTracker::end_tracks(std::int64_t capture_us) {
  const auto max_coast_us = static_cast<std::int64_t>(1e6 * objects_.max_coast_s);
  for (Slot& slot : slots_) {
    if (!slot.in_use) continue;
    bool lost = capture_us - slot.seen_us > max_coast_us;
    if (slot.localised && !slot.seen) {
      // An object behind the camera or out of range will not be detected again.
      const StateVector& x = slot.track.estimate().x;
      lost = lost || x(kX) < kNearestRange_m ||
             x.head<2>().norm() > kMostRangeRatio * detections_.max_distance_m;
    }
    if (lost) slot.in_use = false;
  }
}

void ObjectTracker::report(const TrackView& view, const ObjectsInput& input) {
  output_.capture_us = input.frame->capture_us;
  output_.seq = input.frame->seq;
  for (const Slot& slot : slots_) {
    if (!slot.in_use) continue;
    ObjectOutput object;
    if (slot.localised) object = output_of(slot.track, view, input.motion);
    object.track_id = slot.track_id;
    object.object_class = slot.track.object_class();
    object.reason = slot.reason;
    object.age_s = 1e-6 * static_cast<double>(input.frame->capture_us - slot.begun_us);
    const bool predicted =
        slot.reason == ObjectReason::kNotSeen || slot.reason == ObjectReason::kMisfit;
    if (slot.localised)
      object.status = predicted ? ObjectStatus::kPredicted : ObjectStatus::kMeasured;
    if (!output_.objects.push_back(object)) ++output_.num_refused;
  }
  std::sort(output_.objects.begin(), output_.objects.end(),
            [](const ObjectOutput& a, const ObjectOutput& b) {
              const bool a_localised = a.status != ObjectStatus::kNotLocalised;
              const bool b_localised = b.status != ObjectStatus::kNotLocalised;
              if (a_localised != b_localised) return a_localised;
              const double a_m = a.position_m.norm(), b_m = b.position_m.norm();
              return a_m != b_m ? a_m < b_m : a.track_id < b.track_id;
            });
}

}  // namespace plumb
