#include "modules/ground/ground_node.hpp"

#include <utility>

namespace plumb {
namespace {

// Neighbours may be swapped on their way, so that one motion may come late.
constexpr int kMostBehind = 1;

}  // namespace

GroundNode::GroundNode(const GroundConfig& config, const DetectionsConfig& detections,
                       StageProbe* probe, Sink sink, const GroundModel& model, Factory make)
    : config_(config),
      detections_(detections),
      model_(model),
      make_(std::move(make)),
      probe_(probe),
      sink_(std::move(sink)) {}

void GroundNode::configure_camera(const CameraModel& camera) {
  calibration_.configure(camera);
  build();
}

const char* GroundNode::take_calibration(const camera_calibration_t& message) {
  const char* refused = calibration_.take(message);
  build();
  return refused;
}

/// Makes everything that depends on the camera, when another one holds.
void GroundNode::build() {
  if (!calibration_.take_change()) return;
  if (calibrated()) reset_offset_ = ego_.reset_counter + 1;
  ++num_cameras_;
  waiting_ = false;
  output_ = nullptr;
  const CameraModel& camera = calibration_.camera();
  decoder_.emplace(camera.width_px, camera.height_px);
  images_.emplace(camera.width_px, camera.height_px, static_cast<std::size_t>(config_.images_kept));
  stated_height_ = camera_height_ = camera_height_of(config_, camera);
  if (make_) {
    algorithm_ = make_(camera);
  } else {
    algorithm_ = std::make_unique<GroundEstimator>(config_, camera, model_);
  }
  objects_ = std::make_unique<ObjectsQueue>(config_, detections_, camera, model_.objects_n3);
}

const char* GroundNode::take_image(std::span<const std::uint8_t> image_bytes) {
  ImageFrame frame;
  if (const char* why = read_image(image_bytes, &frame)) return why;
  if (losses_.take(frame.seq) == SeqStep::kRepeat) return "image came twice";
  if (!calibrated()) return "image came before a calibration";
  if (const char* why = decoder_->check(frame)) return why;
  if (waiting_ && last_motion_seq_ == frame.seq && vo_.capture_us == frame.capture_us)
    return process(&frame);
  return images_->put(frame) ? nullptr : "compressed image is larger than the image itself";
}

const char* GroundNode::skip_image(std::span<const std::uint8_t> image_bytes) {
  ImageFrame frame;
  if (const char* why = read_image(image_bytes, &frame)) return why;
  (void)losses_.take(frame.seq);
  skipped_seq_ = frame.seq;
  skipped_capture_us_ = frame.capture_us;
  return nullptr;
}

const char* GroundNode::take_motion(const vo_motion_t& message) {
  expire();
  // A broken message must not change whom this node follows.
  if (const char* why = from_wire(message, &vo_)) return why;
  if (const char* why = follow(message)) return why;
  last_motion_seq_ = message.seq;
  if (!calibrated()) {
    GroundOutput output;
    output.capture_us = vo_.capture_us;
    output.plane.reason = GroundReason::kNoCalibration;
    output.ego.reason = VoReason::kNoCalibration;
    publish(output);
    return nullptr;
  }
  renumber();
  const ImageFrame* frame = images_->find(message.seq, message.utime);
  if (frame == nullptr) {
    waiting_ = true;
    if (skipped_seq_ == message.seq && skipped_capture_us_ == message.utime) expire();
    return nullptr;
  }
  const char* refused = process(frame);
  images_->drop_through(frame);
  return refused;
}

/// Judges sender and order of a motion. Returns null, or why it is refused.
const char* GroundNode::follow(const vo_motion_t& message) {
  is_new_unit_ = false;
  switch (sender_.take(message.session)) {
    case OneSender::Verdict::kForeign:
      return "VO motion comes from a second sender";
    case OneSender::Verdict::kNew:
      if (last_motion_seq_ >= 0) {
        // Another run of plumb-vo counts its units anew, and nothing connects its path to ours.
        is_new_unit_ = true;
        begin_anew(message);
      }
      break;
    case OneSender::Verdict::kSame:
      if (message.prev_seq < 0 && last_motion_seq_ >= 0) {
        begin_anew(message);
      } else if (message.seq <= last_motion_seq_) {
        if (!falls_behind_again(message.seq)) return "VO motion came twice or out of order";
        is_new_unit_ = true;
        begin_anew(message);
      }
      num_behind_ = 0;
      break;
  }
  is_motion_missing_ =
      message.prev_seq >= 0 && last_motion_seq_ >= 0 && message.prev_seq != last_motion_seq_;
  if (is_motion_missing_) ++num_motions_lost_;
  return nullptr;
}

/// One broken number must not shut out all motions after it: two behind it that are in order
/// among themselves are the true ones.
bool GroundNode::falls_behind_again(std::int64_t seq) {
  num_behind_ = num_behind_ > 0 && seq > behind_seq_ ? num_behind_ + 1 : 1;
  behind_seq_ = seq;
  return num_behind_ > kMostBehind;
}

void GroundNode::begin_anew(const vo_motion_t& message) {
  numbers_.begin_anew(message.seq);
  last_motion_seq_ = -1;
  num_behind_ = 0;
}

/// Gives the images of vo_ the numbers that the algorithm sees, which never go back.
void GroundNode::renumber() {
  const bool has_previous = vo_.prev_seq >= 0 && numbers_.is_present(numbers_.steady(vo_.prev_seq));
  vo_.prev_seq = has_previous ? numbers_.steady(vo_.prev_seq) : -1;
  vo_.seq = numbers_.take(vo_.seq);
  for (WindowPose& pose : vo_.window) pose.seq = numbers_.steady(pose.seq);
  if (is_new_unit_) {
    epoch_offset_ = last_epoch_ + 1 - vo_.scale_epoch;
    vo_.scale_carry_std = kNan;
  }
  vo_.scale_epoch += epoch_offset_;
  last_epoch_ = vo_.scale_epoch;
  if (is_motion_missing_ && vo_.reason == VoReason::kNone) vo_.reason = VoReason::kMotionMissing;
}

const char* GroundNode::take_detections(const detections_t& message) {
  if (const char* why = from_wire(message, &arrived_)) return why;
  if (!calibrated()) return "detections came before a calibration";
  arrived_.seq = numbers_.steady(arrived_.seq);
  return objects_->take(arrived_);
}

void GroundNode::expire() {
  if (waiting_) (void)process(nullptr);
}

const char* GroundNode::process(const ImageFrame* frame) {
  waiting_ = false;
  probe_->begin();
  GroundInput input{
      &vo_, {}, objects_->update(vo_, camera_height_), camera_height_, is_height_correction_};
  input.due = objects_->due();
  const char* refused = nullptr;
  if (frame != nullptr) refused = decoder_->decode(*frame, &input.image);
  if (input.image.empty()) ++num_unpaired_;
  probe_->mark("decode");
  output_ = &algorithm_->update(input, *probe_);
  objects_->note(output_->plane);
  publish(*output_);
  return refused;
}

void GroundNode::publish(const GroundOutput& output) {
  to_wire(output, &plane_);
  // Upside down, the plane that was found is none. The estimators go on with it, because it mostly
  // turns out to be right.
  if (vo_.reason == VoReason::kOrientationUnproven) withhold_plane(&plane_);
  to_wire(output, &ego_);
  plane_.seq = ego_.seq = last_motion_seq_;
  ego_.reset_counter += reset_offset_;
  plane_.session = ego_.session = session_;
  plane_.capture_mono_us = ego_.capture_mono_us = vo_.capture_mono_us;
  probe_->mark("to_wire");
  sink_(plane_, ego_);
}

}  // namespace plumb
