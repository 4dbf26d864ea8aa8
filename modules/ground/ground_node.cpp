#include "modules/ground/ground_node.hpp"

#include <utility>

namespace plumb {

GroundNode::GroundNode(const GroundConfig& config, const DetectionsConfig& detections,
                       StageProbe* probe, Sink sink, const GroundModel& model, Factory make)
    : config_(config),
      detections_(detections),
      model_(model),
      make_(std::move(make)),
      probe_(probe),
      sink_(std::move(sink)) {}

const char* GroundNode::take_calibration(const camera_calibration_t& message) {
  CameraModel camera;
  if (const char* why = from_wire(message, &camera)) return why;
  if (calibrated())
    return same_camera(camera, camera_)
               ? nullptr
               : "calibration differs from the first one; restart to use it";
  camera_ = camera;
  decoder_.emplace(camera.width_px, camera.height_px);
  images_.emplace(camera.width_px, camera.height_px);
  camera_height_ = camera_height_of(config_, camera);
  if (make_) {
    algorithm_ = make_(camera);
  } else {
    algorithm_ = std::make_unique<GroundEstimator>(config_, camera, model_);
  }
  objects_ = std::make_unique<ObjectsQueue>(config_, detections_, camera, model_.objects_n3);
  return nullptr;
}

const char* GroundNode::take_image(std::span<const std::uint8_t> image_bytes) {
  ImageFrame frame;
  if (const char* why = read_image(image_bytes, &frame)) return why;
  if (losses_.take(frame.seq) == SeqStep::kRepeat) return "image came twice";
  if (!calibrated()) return "image came before a calibration";
  if (const char* why = decoder_->check(frame)) return why;
  if (waiting_ && vo_.seq == frame.seq && vo_.capture_us == frame.capture_us)
    return process(&frame);
  return images_->put(frame) ? nullptr : "compressed image is larger than the image itself";
}

const char* GroundNode::take_motion(const vo_motion_t& message) {
  expire();
  if (const char* why = from_wire(message, &vo_)) return why;
  count_lost_motion(message);
  if (!calibrated()) {
    GroundOutput output;
    output.capture_us = vo_.capture_us;
    output.seq = vo_.seq;
    output.plane.reason = GroundReason::kNoCalibration;
    output.ego.reason = VoReason::kNoCalibration;
    publish(output);
    return nullptr;
  }
  const ImageFrame* frame = images_->find(vo_.seq, vo_.capture_us);
  if (frame == nullptr) {
    waiting_ = true;
    return nullptr;
  }
  const char* refused = process(frame);
  images_->drop_through(frame);
  return refused;
}

const char* GroundNode::take_detections(const detections_t& message) {
  if (const char* why = from_wire(message, &arrived_)) return why;
  if (!calibrated()) return "detections came before a calibration";
  return objects_->take(arrived_);
}

void GroundNode::expire() {
  if (waiting_) (void)process(nullptr);
}

// prev_seq names the image that VO had before. Its motion must have arrived here too.
void GroundNode::count_lost_motion(const vo_motion_t& message) {
  if (any_motion_ && message.prev_seq > last_motion_seq_ && message.prev_seq < message.seq)
    ++num_motions_lost_;
  any_motion_ = true;
  last_motion_seq_ = message.seq;
}

const char* GroundNode::process(const ImageFrame* frame) {
  waiting_ = false;
  probe_->begin();
  GroundInput input{&vo_, {}, objects_->update(vo_, camera_height_), camera_height_};
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
  to_wire(output, &ego_);
  plane_.session = ego_.session = session_;
  plane_.capture_mono_us = ego_.capture_mono_us = vo_.capture_mono_us;
  probe_->mark("to_wire");
  sink_(plane_, ego_);
}

}  // namespace plumb
