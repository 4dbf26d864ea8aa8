#include "modules/ground/cues/objects_queue.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "modules/detections/road_plane.hpp"

namespace plumb {
namespace {

constexpr double kUnknownRollStd = 2.0 * kDegree;
constexpr double kTurnStd = 0.05 * kDegree;  ///< of VO's rotation, per image

bool gives_rotation(VoStatus status) {
  return status == VoStatus::kOk || status == VoStatus::kRotationOnly ||
         status == VoStatus::kCoasting || status == VoStatus::kStandstill;
}

}  // namespace

ObjectsQueue::ObjectsQueue(const GroundConfig& config, const DetectionsConfig& detections,
                           const CameraModel& camera, const LinearVariance& model)
    : delay_(static_cast<std::size_t>(config.detections_delay_images)),
      adapts_(config.covariance != "fixed"),
      model_(model),
      pitch_(detections, camera) {}

const char* ObjectsQueue::take(const DetectionFrame& frame) {
  if (delay_ == 0) return nullptr;
  if (frame.capture_us <= last_due_us_)
    return "detections came later than ground.detections_delay_images allows";
  if (frame.capture_us <= last_taken_us_) return "detections of an image that is not newer";
  last_taken_us_ = frame.capture_us;
  if (waiting_[next_waiting_].capture_us > last_due_us_) ++num_overflowed_;
  waiting_[next_waiting_] = frame;
  next_waiting_ = (next_waiting_ + 1) % kMaxWaiting;
  return nullptr;
}

std::span<const ObjectsMeasurement> ObjectsQueue::update(const VoOutput& vo,
                                                         const CameraHeight& camera_height) {
  proceed_to(vo);
  due_ = {};
  if (delay_ == 0 || num_places_ <= delay_) return {};
  const Place& place = places_[delay_];
  last_due_us_ = place.capture_us;
  const DetectionFrame* frame = find(place);
  due_ = {frame, place.R_newest_place};
  if (frame == nullptr || !measure(place, *frame, camera_height.height_m)) return {};
  return {&measured_, 1};
}

void ObjectsQueue::proceed_to(const VoOutput& vo) {
  const bool any = num_places_ > 0;
  if (any && vo.capture_us < places_.front().capture_us) {  // the source has restarted
    waiting_.fill({});
    last_taken_us_ = last_due_us_ = 0;
  }
  const bool joins = any && gives_rotation(vo.status) && places_.front().seq == vo.prev_seq;
  if (!joins) num_places_ = 0;
  const Eigen::Matrix3d R_cam_prev = vo.T_prev_cam.R.transpose();
  num_places_ = std::min(num_places_ + 1, places_.size());
  for (std::size_t i = num_places_ - 1; i > 0; --i) {
    places_[i] = places_[i - 1];
    places_[i].R_newest_place = R_cam_prev * places_[i - 1].R_newest_place;
  }
  places_.front() = Place{};
  places_.front().seq = vo.seq;
  places_.front().capture_us = vo.capture_us;
}

void ObjectsQueue::note(const PlaneOutput& plane) {
  Place& place = places_.front();
  place.has_roll = plane.status == GroundStatus::kOk || plane.status == GroundStatus::kHeld;
  place.roll_rad = plane.roll_rad;
  place.roll_var_rad2 = plane.cov(1, 1);
  const CueReport& dense = plane.cues[kCueDense];
  place.has_pitch = dense.status == CueStatus::kUsed;
  if (!place.has_pitch) return;
  place.pitch_rad = std::asin(std::clamp(dense.n3, -1.0, 1.0));
  place.pitch_var_rad2 = dense.n3_var;
}

const DetectionFrame* ObjectsQueue::find(const Place& place) const {
  for (const DetectionFrame& frame : waiting_) {
    if (frame.seq == place.seq && frame.capture_us == place.capture_us) return &frame;
  }
  return nullptr;
}

bool ObjectsQueue::measure(const Place& place, const DetectionFrame& frame, double height_m) {
  ObjectsPitchInput input;
  input.frame = &frame;
  input.height_m = height_m;
  input.roll_rad = place.has_roll ? place.roll_rad : 0.0;
  input.roll_std_rad = place.has_roll ? std::sqrt(place.roll_var_rad2) : kUnknownRollStd;
  input.has_other = place.has_pitch;
  input.other_pitch_rad = place.pitch_rad;
  input.other_var_rad2 = place.pitch_var_rad2;
  const ObjectsPitchOutput& seen = pitch_.update(input);
  if (seen.status != ObjectsPitchStatus::kValid) return false;

  const double pitch = std::asin(std::clamp(seen.n3, -1.0, 1.0));
  const Eigen::Vector3d normal =
      place.R_newest_place * RoadPlane{pitch, input.roll_rad}.normal_cam();
  measured_.n3 = normal.z();
  measured_.confidence = seen.n3_var;
  measured_.n3_var = (adapts_ ? model_.of(seen.n3_var) : model_.mean) +
                     static_cast<double>(delay_) * square(kTurnStd);
  measured_.quality = seen.quality;
  return true;
}

}  // namespace plumb
