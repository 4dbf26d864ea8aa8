#include "modules/vo/image_health.hpp"

#include <cmath>
#include <cstring>

namespace plumb::vo {
namespace {

constexpr int kRowStep = 4;

bool identical(const ImageView& a, const ImageView& b) {
  for (int v = 0; v < a.height_px; ++v) {
    if (std::memcmp(a.row(v), b.row(v), static_cast<std::size_t>(a.width_px)) != 0) return false;
  }
  return true;
}

}  // namespace

ImageLevels measure_levels(const ImageView& image) {
  std::int64_t sum = 0;
  std::int64_t sum_squares = 0;
  std::int64_t count = 0;
  for (int v = 0; v < image.height_px; v += kRowStep) {
    const std::uint8_t* row = image.row(v);
    std::uint32_t s = 0;
    std::uint32_t ss = 0;  // sufficient for 66000 columns: 255^2 x 66000 < 2^32
    for (int u = 0; u < image.width_px; ++u) {
      const std::uint32_t p = row[u];
      s += p;
      ss += p * p;
    }
    sum += s;
    sum_squares += ss;
    count += image.width_px;
  }
  const double mean = static_cast<double>(sum) / static_cast<double>(count);
  const double square = static_cast<double>(sum_squares) / static_cast<double>(count);
  return {mean, std::sqrt(std::max(0.0, square - mean * mean))};
}

VoReason judge_image(const ImageView& image, const ImageView& previous, const VoConfig& config) {
  const ImageLevels levels = measure_levels(image);
  if (levels.mean_grey < config.dark_grey) return VoReason::kImageDark;
  if (levels.std_grey < config.flat_std_grey) return VoReason::kImageFlat;
  if (!previous.empty() && identical(image, previous)) return VoReason::kImageFrozen;
  return VoReason::kNone;
}

}  // namespace plumb::vo
