#include "modules/detector/detector_node.hpp"

namespace plumb {

const char* DetectorNode::take_image(std::span<const std::uint8_t> image_bytes) {
  ImageFrame frame;
  if (const char* why = read_image(image_bytes, &frame)) return why;
  if (waiting_) ++num_skipped_;
  newest_.assign(image_bytes.begin(), image_bytes.end());
  waiting_ = true;
  return nullptr;
}

const detections_t* DetectorNode::search(const char** refused) {
  *refused = nullptr;
  if (!waiting_) return nullptr;
  waiting_ = false;
  ImageFrame image;
  *refused = read_image(newest_, &image);
  if (*refused != nullptr) return nullptr;
  if (image.width_px != width_px_ || image.height_px != height_px_) {
    width_px_ = image.width_px;
    height_px_ = image.height_px;
    decoder_.emplace(width_px_, height_px_);
  }
  ImageView view;
  *refused = decoder_->decode(image, &view);
  if (*refused != nullptr) return nullptr;
  frame_.capture_us = image.capture_us;
  frame_.seq = image.seq;
  suppress(&network_.find(view), config_.suppress_overlap_ratio, &frame_);
  to_wire(frame_, &message_);
  return &message_;
}

}  // namespace plumb
