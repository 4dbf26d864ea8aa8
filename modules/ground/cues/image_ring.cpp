#include "modules/ground/cues/image_ring.hpp"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

// A camera 5.7 degrees nose-up still sees its horizon in the kept rows.
constexpr double kRowsAboveHorizonRatio = 0.1;

// The coarsest level has about this focal length: a step of one camera height then moves the road
// by a few pixels.
constexpr double kCoarsestFocalPx = 180.0;

int choose_num_levels(const CameraModel& camera) {
  const int wanted = 1 + static_cast<int>(std::lround(std::log2(camera.fy_px / kCoarsestFocalPx)));
  return std::clamp(wanted, 1, Pyramid::kMaxLevels);
}

}  // namespace

ImageRing::ImageRing(const CameraModel& camera)
    : camera_(camera), full_height_px_(camera.height_px), num_levels_(choose_num_levels(camera)) {
  const double row = camera.cy_px - kRowsAboveHorizonRatio * camera.fy_px;
  const int last_possible = camera.height_px - (1 << Pyramid::kMaxLevels);
  first_row_ = std::clamp(static_cast<int>(row), 0, std::max(0, last_possible));
  camera_.cy_px -= first_row_;
  camera_.height_px -= first_row_;
  pyramids_.reserve(kCapacity);
  for (std::size_t i = 0; i < kCapacity; ++i) {
    pyramids_.emplace_back(camera_.width_px, camera_.height_px, num_levels_);
  }
  seqs_.fill(kNone);
}

bool ImageRing::fits(const ImageView& image) const {
  return !image.empty() && image.width_px == camera_.width_px && image.height_px == full_height_px_;
}

const Pyramid& ImageRing::push(std::int64_t seq, const ImageView& image) {
  const ImageView road{image.row(first_row_), camera_.width_px, camera_.height_px,
                       image.stride_bytes};
  Pyramid& slot = pyramids_[next_];
  slot.build(road);
  seqs_[next_] = seq;
  next_ = (next_ + 1) % kCapacity;
  return slot;
}

const Pyramid& ImageRing::replace_newest(std::int64_t seq, const ImageView& image) {
  next_ = (next_ + kCapacity - 1) % kCapacity;
  return push(seq, image);
}

const Pyramid* ImageRing::find(std::int64_t seq) const {
  for (std::size_t i = 0; i < kCapacity; ++i) {
    if (seqs_[i] == seq) return &pyramids_[i];
  }
  return nullptr;
}

}  // namespace plumb
