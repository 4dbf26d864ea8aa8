#include "modules/detections/detections_wire.hpp"

#include "core/same_value.hpp"

#include <cmath>

namespace plumb {
namespace {

static_assert(same(ObjectClass::kUnknown, detection_t::CLASS_UNKNOWN));
static_assert(same(ObjectClass::kCar, detection_t::CLASS_CAR));
static_assert(same(ObjectClass::kVan, detection_t::CLASS_VAN));
static_assert(same(ObjectClass::kTruck, detection_t::CLASS_TRUCK));
static_assert(same(ObjectClass::kBus, detection_t::CLASS_BUS));
static_assert(same(ObjectClass::kPedestrian, detection_t::CLASS_PEDESTRIAN));
static_assert(same(ObjectClass::kCyclist, detection_t::CLASS_CYCLIST));
static_assert(kMaxDetections == detections_t::MAX_DETECTIONS);
static_assert(sizeof(detection_t::candidate_scores) / sizeof(float) == kMaxCandidates);

constexpr double kFarthest_px = 1e5;  ///< larger than any image

/// Reads a box. Returns false when it is empty, not finite or far outside any image.
bool read_box(const float (&edges)[4], Box* box) {
  *box = {static_cast<double>(edges[0]), static_cast<double>(edges[1]),
          static_cast<double>(edges[2]), static_cast<double>(edges[3])};
  for (const float edge : edges) {
    if (!(std::abs(static_cast<double>(edge)) <= kFarthest_px)) return false;
  }
  return box->width_px() > 0.0 && box->height_px() > 0.0;
}

const char* candidates_from_wire(const detection_t& message, Detection* detection) {
  const int count = message.num_candidates;
  if (count < 0 || count > static_cast<int>(kMaxCandidates)) {
    return "detections: number of candidates is outside [0, 16]";
  }
  for (int i = 0; i < count; ++i) {
    Candidate candidate;
    candidate.score = static_cast<double>(message.candidate_scores[i]);
    if (!read_box(message.candidates_px[i], &candidate.box) || !std::isfinite(candidate.score) ||
        !detection->candidates.push_back(candidate)) {
      return "detections: a candidate is empty or not a number";
    }
  }
  return nullptr;
}

const char* detection_from_wire(const detection_t& message, Detection* detection) {
  if (message.class_id < 0 || message.class_id >= static_cast<std::int8_t>(kNumObjectClasses)) {
    return "detections: unknown class";
  }
  if (message.occluded < 0 || message.occluded > static_cast<std::int8_t>(Occlusion::kUnknown)) {
    return "detections: unknown degree of occlusion";
  }
  if (message.track_id < -1) return "detections: track id is below -1";
  detection->track_id = message.track_id;
  detection->object_class = static_cast<ObjectClass>(message.class_id);
  detection->score = static_cast<double>(message.score);
  detection->truncated_ratio = static_cast<double>(message.truncated_ratio);
  detection->occluded = static_cast<Occlusion>(message.occluded);
  if (!(detection->score >= 0.0 && detection->score <= 1.0)) {
    return "detections: score is outside [0, 1]";
  }
  if (detection->truncated_ratio < 0.0 || detection->truncated_ratio > 1.0) {
    return "detections: truncation is outside [0, 1]";
  }
  if (!read_box(message.box_px, &detection->box)) {
    return "detections: a box is empty or not a number";
  }
  return candidates_from_wire(message, detection);
}

bool is_tracked_twice(const DetectionFrame& frame, std::int32_t track_id) {
  for (const Detection& other : frame.detections) {
    if (track_id >= 0 && other.track_id == track_id) return true;
  }
  return false;
}

void write_box(const Box& box, float (&edges)[4]) {
  edges[0] = static_cast<float>(box.left_px);
  edges[1] = static_cast<float>(box.top_px);
  edges[2] = static_cast<float>(box.right_px);
  edges[3] = static_cast<float>(box.bottom_px);
}

}  // namespace

const char* from_wire(const detections_t& message, DetectionFrame* frame) {
  if (message.num_detections < 0 || message.num_detections > detections_t::MAX_DETECTIONS ||
      message.detections.size() != static_cast<std::size_t>(message.num_detections)) {
    return "detections: number is outside [0, 64]";
  }
  frame->capture_us = message.utime;
  frame->seq = message.seq;
  frame->detections.clear();
  for (const detection_t& one : message.detections) {
    Detection detection;
    if (const char* why = detection_from_wire(one, &detection)) return why;
    if (is_tracked_twice(*frame, detection.track_id)) return "detections: a track id occurs twice";
    if (!frame->detections.push_back(detection)) return "detections: number is outside [0, 64]";
  }
  return nullptr;
}

void to_wire(const DetectionFrame& frame, detections_t* message) {
  message->utime = frame.capture_us;
  message->seq = frame.seq;
  message->num_detections = static_cast<std::int32_t>(frame.detections.size());
  message->detections.resize(frame.detections.size());
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    const Detection& detection = frame.detections[i];
    detection_t& out = message->detections[i];
    out = {};
    out.track_id = detection.track_id;
    out.class_id = static_cast<std::int8_t>(detection.object_class);
    out.score = static_cast<float>(detection.score);
    write_box(detection.box, out.box_px);
    out.truncated_ratio = static_cast<float>(detection.truncated_ratio);
    out.occluded = static_cast<std::int8_t>(detection.occluded);
    out.num_candidates = static_cast<std::int8_t>(detection.candidates.size());
    for (std::size_t c = 0; c < detection.candidates.size(); ++c) {
      write_box(detection.candidates[c].box, out.candidates_px[c]);
      out.candidate_scores[c] = static_cast<float>(detection.candidates[c].score);
    }
  }
}

}  // namespace plumb
