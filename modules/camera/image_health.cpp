#include "modules/camera/image_health.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "modules/camera/convert.hpp"

namespace plumb {

const char* describe(ImageFault fault) {
  switch (fault) {
    case ImageFault::kBlack:
      return "the image is black";
    case ImageFault::kFlat:
      return "the image is flat: lens covered, fog or saturation";
    case ImageFault::kFrozen:
      return "the image is frozen: every pixel equals that of the previous image";
    case ImageFault::kNone:
      break;
  }
  return "";
}

ImageHealth::ImageHealth(int width_px, int height_px, const ImageHealthLimits& limits)
    : limits_(limits),
      previous_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}

ImageFault ImageHealth::update(const ImageView& image) {
  measure(image);
  const bool frozen = has_previous_ && equals_previous(image);
  if (!frozen) copy_rows(image, previous_.data());
  has_previous_ = true;

  const ImageFault now = judge(frozen);
  num_pending_ = now == pending_ ? std::min(num_pending_ + 1, limits_.fault_frames) : 1;
  pending_ = now;
  if (num_pending_ >= limits_.fault_frames) fault_ = now;
  return fault_;
}

void ImageHealth::measure(const ImageView& image) {
  // Every fourth row suffices for mean and standard deviation and keeps the time below 0.1 ms.
  constexpr int kRowStep = 4;
  std::uint64_t sum = 0;
  std::uint64_t sum2 = 0;
  std::uint64_t count = 0;
  for (int v = 0; v < image.height_px; v += kRowStep) {
    const std::uint8_t* row = image.row(v);
    std::uint32_t row_sum = 0;
    std::uint32_t row_sum2 = 0;  // 8192 * 255^2 < 2^32
    for (int u = 0; u < image.width_px; ++u) {
      const std::uint32_t grey = row[u];
      row_sum += grey;
      row_sum2 += grey * grey;
    }
    sum += row_sum;
    sum2 += row_sum2;
    count += static_cast<std::uint64_t>(image.width_px);
  }
  const auto n = static_cast<double>(count);
  mean_ = static_cast<double>(sum) / n;
  std_dev_ = std::sqrt(std::max(0.0, static_cast<double>(sum2) / n - mean_ * mean_));
}

bool ImageHealth::equals_previous(const ImageView& image) const {
  const auto width = static_cast<std::size_t>(image.width_px);
  for (int v = 0; v < image.height_px; ++v) {
    if (std::memcmp(image.row(v), &previous_[static_cast<std::size_t>(v) * width], width) != 0) {
      return false;
    }
  }
  return true;
}

ImageFault ImageHealth::judge(bool frozen) const {
  if (std_dev_ < limits_.flat_std) {
    return mean_ <= limits_.black_mean ? ImageFault::kBlack : ImageFault::kFlat;
  }
  return frozen ? ImageFault::kFrozen : ImageFault::kNone;
}

}  // namespace plumb
