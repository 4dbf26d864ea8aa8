#include "modules/objects/objects_node.hpp"

#include <algorithm>
#include <utility>

namespace plumb {
namespace {

constexpr double kCalibratedRollStd = 0.01;    ///< [rad]
constexpr double kCalibratedHeightStd = 0.01;  ///< [ratio]
constexpr double kLongestGap_s = 2.0;          ///< a longer gap is predicted as one of this length

bool is_motion_valid(EgoStatus status) {
  return status == EgoStatus::kOk || status == EgoStatus::kScaleHeld ||
         status == EgoStatus::kStandstill || status == EgoStatus::kCoasting;
}

/// Takes the motion of the ground axes from that of the camera. The tilt of the camera against the
/// road changes it by less than a thousandth.
void set_motion(const Se3& T_prev_cam, GroundMotion* motion) {
  motion->known = true;
  motion->t_m = {T_prev_cam.t.z(), -T_prev_cam.t.x()};
  motion->yaw_rad = -log_so3(T_prev_cam.R).y();
}

}  // namespace

ObjectsNode::ObjectsNode(const DetectionsConfig& detections, const ObjectsConfig& objects,
                         const GroundConfig& ground, Sink sink)
    : detections_(detections),
      objects_(objects),
      config_height_m_(ground.camera_height_m),
      sink_(std::move(sink)) {
  message_.objects.reserve(kMaxObjects);
}

void ObjectsNode::configure_camera(const CameraModel& camera) {
  calibration_.configure(camera);
  build();
}

const char* ObjectsNode::take_calibration(const camera_calibration_t& message) {
  const char* refused = calibration_.take(message);
  build();
  return refused;
}

/// Creates the tracker when another camera holds. Tracks of an earlier camera are dropped.
void ObjectsNode::build() {
  if (!calibration_.take_change()) return;
  if (calibrated()) {
    reset();
  } else {
    tracker_.emplace(detections_, objects_, calibration_.camera());
  }
}

const char* ObjectsNode::take_plane(const ground_plane_t& message) {
  if (has_plane_) ++num_lost_;
  plane_ = message;
  has_plane_ = true;
  return has_ego_ && ego_.seq == plane_.seq ? pair(plane_, ego_) : nullptr;
}

const char* ObjectsNode::take_ego(const ego_motion_t& message) {
  if (has_ego_) ++num_lost_;
  ego_ = message;
  has_ego_ = true;
  return has_plane_ && ego_.seq == plane_.seq ? pair(plane_, ego_) : nullptr;
}

const char* ObjectsNode::pair(const ground_plane_t& plane, const ego_motion_t& ego) {
  has_plane_ = has_ego_ = false;
  if (const char* why = from_wire(plane, ego, &output_)) return why;
  if (output_.capture_us < newest_plane_us_) reset();
  newest_plane_us_ = output_.capture_us;
  Ground& ground = kept_[next_];
  next_ = (next_ + 1) % kKept;
  ground.seq = output_.seq;
  ground.capture_us = output_.capture_us;
  ground.capture_mono_us = plane.capture_mono_us;
  const PlaneOutput& out = output_.plane;
  ground.plane_valid = out.status == GroundStatus::kOk || out.status == GroundStatus::kHeld;
  ground.plane = {out.pitch_rad, out.roll_rad, out.height_m, out.cov};
  ground.motion_valid = is_motion_valid(output_.ego.status);
  ground.reset_counter = output_.ego.reset_counter;
  ground.T_world_cam = output_.ego.T_world_cam;
  // Planes arrive in order, so a plane that has not arrived before this one was lost.
  while (waiting() && waiting_.front().capture_us <= ground.capture_us) {
    const DetectionFrame& oldest = waiting_.front();
    const bool same = oldest.seq == ground.seq && oldest.capture_us == ground.capture_us;
    process_oldest(same ? &ground : nullptr);
  }
  return nullptr;
}

const char* ObjectsNode::take_detections(const detections_t& message) {
  if (const char* why = from_wire(message, &arrived_)) return why;
  if (!calibrated()) return "detections came before a calibration";
  if (any_taken_ && arrived_.capture_us <= newest_us_) {
    return "detections of an image that is not newer than the last one";
  }
  any_taken_ = true;
  newest_us_ = arrived_.capture_us;
  if (const Ground* ground = find(arrived_.seq, arrived_.capture_us)) {
    expire();
    process(arrived_, ground);
    return nullptr;
  }
  if (waiting_.full()) process_oldest(nullptr);
  (void)waiting_.push(arrived_);
  return nullptr;
}

void ObjectsNode::reset() {
  kept_.fill({});
  waiting_.clear();
  any_taken_ = any_processed_ = false;
  tracker_.emplace(detections_, objects_, calibration_.camera());
}

void ObjectsNode::expire() {
  while (waiting()) process_oldest(nullptr);
}

void ObjectsNode::process_oldest(const Ground* ground) {
  process(waiting_.front(), ground);
  waiting_.drop_front();
}

const ObjectsNode::Ground* ObjectsNode::find(std::int64_t seq, std::int64_t capture_us) const {
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Ground& ground) {
    return ground.seq == seq && ground.capture_us == capture_us;
  });
  return found == kept_.end() ? nullptr : &*found;
}

RoadPlane ObjectsNode::calibrated_plane() const {
  RoadPlane plane;
  plane.pitch_rad = detections_.mean_pitch_rad;
  const double stated_m = calibration_.camera().camera_height_m;
  plane.height_m = stated_m > 0.0 ? stated_m : config_height_m_;
  plane.cov.diagonal() << detections_.pitch_std_rad * detections_.pitch_std_rad,
      kCalibratedRollStd * kCalibratedRollStd, kCalibratedHeightStd * kCalibratedHeightStd;
  return plane;
}

void ObjectsNode::process(const DetectionFrame& frame, const Ground* ground) {
  ObjectsInput input;
  input.frame = &frame;
  input.plane_measured = ground != nullptr && ground->plane_valid && objects_.plane == "measured";
  input.plane = input.plane_measured ? ground->plane : calibrated_plane();

  Ground now;  // without a plane its capture time is not known
  if (ground != nullptr) {
    now = *ground;
  } else {
    ++num_unpaired_;
  }
  now.seq = frame.seq;
  now.capture_us = frame.capture_us;
  if (any_processed_) {
    input.motion.dt_s =
        std::min(1e-6 * static_cast<double>(now.capture_us - last_.capture_us), kLongestGap_s);
    if (now.motion_valid && last_.motion_valid && now.reset_counter == last_.reset_counter) {
      set_motion(last_.T_world_cam.inverse() * now.T_world_cam, &input.motion);
    }
  }
  last_ = now;
  any_processed_ = true;
  to_wire(tracker_->update(input), &message_);
  message_.capture_mono_us = now.capture_mono_us;
  sink_(message_);
}

}  // namespace plumb
