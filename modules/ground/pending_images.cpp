#include "modules/ground/pending_images.hpp"

#include <cstring>

namespace plumb {

PendingImages::PendingImages(int width_px, int height_px, std::size_t num_slots)
    : slot_bytes_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)),
      storage_(num_slots * slot_bytes_),
      frames_(num_slots) {}

bool PendingImages::put(const ImageFrame& frame) {
  const auto width = static_cast<std::size_t>(frame.width_px);
  const auto height = static_cast<std::size_t>(frame.height_px);
  const std::size_t bytes = frame.compressed ? frame.data.size() : width * height;
  if (bytes > slot_bytes_) return false;
  if (size_ == frames_.size()) {
    first_ = (first_ + 1) % frames_.size();
    --size_;
    ++num_overflowed_;
  }
  const std::size_t slot = (first_ + size_) % frames_.size();
  std::uint8_t* out = storage_.data() + slot * slot_bytes_;
  if (frame.compressed) {
    std::memcpy(out, frame.data.data(), bytes);
  } else {
    const auto stride = static_cast<std::size_t>(frame.row_stride_bytes);
    for (std::size_t v = 0; v < height; ++v)
      std::memcpy(out + v * width, frame.data.data() + v * stride, width);
  }
  frames_[slot] = frame;
  frames_[slot].row_stride_bytes = frame.compressed ? 0 : frame.width_px;
  frames_[slot].data = {out, bytes};
  ++size_;
  return true;
}

const ImageFrame* PendingImages::find(std::int64_t seq, std::int64_t capture_us) const {
  for (std::size_t i = 0; i < size_; ++i) {
    const ImageFrame& frame = frames_[(first_ + i) % frames_.size()];
    if (frame.seq == seq && frame.capture_us == capture_us) return &frame;
  }
  return nullptr;
}

void PendingImages::drop_through(const ImageFrame* frame) {
  while (size_ > 0) {
    const bool last = &frames_[first_] == frame;
    first_ = (first_ + 1) % frames_.size();
    --size_;
    if (last) return;
  }
}

}  // namespace plumb
