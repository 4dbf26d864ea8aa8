#include "modules/vo/image_health.hpp"

#include <cmath>

namespace plumb::vo {
namespace {

constexpr int kRowStep = 4;

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

VoReason judge_image(const ImageView& image, const VoConfig& config) {
  const ImageLevels levels = measure_levels(image);
  if (levels.mean_grey < config.dark_grey) return VoReason::kImageDark;
  if (levels.std_grey < config.flat_std_grey) return VoReason::kImageFlat;
  return VoReason::kNone;
}

}  // namespace plumb::vo
