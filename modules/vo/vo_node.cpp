#include "modules/vo/vo_node.hpp"

namespace plumb {

VoNode::VoNode(const VoConfig& config, std::uint64_t seed, StageProbe* probe)
    : config_(config), seed_(seed), probe_(probe) {}

const char* VoNode::take_calibration(const camera_calibration_t& message) {
  CameraModel camera;
  if (const char* why = from_wire(message, &camera)) return why;
  if (calibrated())
    return same_camera(camera, camera_)
               ? nullptr
               : "calibration differs from the first one; restart to use it";
  camera_ = camera;
  decoder_.emplace(camera.width_px, camera.height_px);
  estimator_.emplace(config_, camera, seed_);
  return nullptr;
}

const char* VoNode::take_image(std::span<const std::uint8_t> image_bytes,
                               [[maybe_unused]] std::int64_t arrival_us) {
  fresh_ = false;
  probe_->begin();
  ImageFrame frame;
  if (const char* why = read_image(image_bytes, &frame)) return why;
  if (losses_.take(frame.seq) == SeqStep::kRepeat) return "image came twice";
  if (!calibrated()) return publish_without_calibration(frame);
  VoInput input{frame.capture_us, frame.seq, {}};
  if (const char* why = decoder_->decode(frame, &input.image)) return why;
  probe_->mark("decode");
  to_wire(estimator_->update(input, *probe_), &motion_);
  probe_->mark("to_wire");
  fresh_ = true;
  return nullptr;
}

const char* VoNode::publish_without_calibration(const ImageFrame& frame) {
  VoOutput output;
  output.capture_us = frame.capture_us;
  output.seq = frame.seq;
  output.reason = VoReason::kNoCalibration;
  to_wire(output, &motion_);
  fresh_ = true;
  return "image came before a calibration";
}

}  // namespace plumb
