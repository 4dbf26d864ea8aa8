#include "modules/ground_paper/road_region.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/numbers.hpp"
#include "core/simd.hpp"
#include "modules/ground/cues/homography_warp.hpp"

namespace plumb {
namespace {

constexpr double kLeastOverlap = 0.5;

/// Interpolates along u in the row `row_offset` below the warped ray.
inline void sample_row(const ImageView& image, const WarpedRays& at, int row_offset, Float8* out) {
  Int8 words{};
  for (int lane = 0; lane < kNumLanes; ++lane) {
    std::uint16_t pair = 0;
    std::memcpy(&pair, image.row(at.row[lane] + row_offset) + at.column[lane], sizeof(pair));
    words[lane] = pair;
  }
  const Float8 left = __builtin_convertvector(words & 0xff, Float8);
  const Float8 right = __builtin_convertvector(words >> 8, Float8);
  *out = left + at.fu * (right - left);
}

}  // namespace

PixelBox region_of(const CameraModel& camera, double width_ratio, double height_ratio) {
  const int width = std::max(8, static_cast<int>(std::lround(width_ratio * camera.width_px)));
  const int height = std::max(8, static_cast<int>(std::lround(height_ratio * camera.height_px)));
  const int u0 = std::max(0, (camera.width_px - width) / 2);
  const int v0 = std::max(0, camera.height_px - height);
  return {u0, std::min(camera.width_px, u0 + width), v0, camera.height_px};
}

RoadRegion::RoadRegion(const CameraModel& camera, const PixelBox& box)
    : camera_(camera), box_(box) {
  size_ = static_cast<std::size_t>(box.u1 - box.u0) * static_cast<std::size_t>(box.v1 - box.v0);
  const std::size_t padded = (size_ + kNumLanes - 1) / kNumLanes * kNumLanes;
  x_.assign(padded, 0.0F);
  y_.assign(padded, 0.0F);
  grey_.assign(padded, std::numeric_limits<float>::quiet_NaN());
  std::size_t i = 0;
  for (int v = box.v0; v < box.v1; ++v) {
    for (int u = box.u0; u < box.u1; ++u, ++i) {
      const Eigen::Vector2d ray = camera.to_normalized(Eigen::Vector2d(u, v));
      x_[i] = static_cast<float>(ray.x());
      y_[i] = static_cast<float>(ray.y());
    }
  }
}

void RoadRegion::take(const ImageView& image) {
  std::size_t i = 0;
  for (int v = box_.v0; v < box_.v1; ++v) {
    const std::uint8_t* row = image.row(v);
    for (int u = box_.u0; u < box_.u1; ++u) grey_[i++] = static_cast<float>(row[u]);
  }
}

double RoadRegion::sad(const ImageView& old_image, const Se3& T_old_cam,
                       const Eigen::Vector3d& q) const {
  const Homography h = make_homography(T_old_cam, q);
  const LevelCamera camera = camera_of_level(camera_, 0);
  Float8 sum{}, count{};
  for (std::size_t i = 0; i < grey_.size(); i += kNumLanes) {
    Float8 x, y, grey, upper, lower;
    x = load_floats(x_.data() + i);
    y = load_floats(y_.data() + i);
    grey = load_floats(grey_.data() + i);
    WarpedRays at{};
    warp_rays(h, camera, old_image, x, y, 0, &at);
    sample_row(old_image, at, 0, &upper);
    sample_row(old_image, at, 1, &lower);
    const Float8 difference = upper + at.fv * (lower - upper) - grey;
    const Float8 size = difference < 0.0F ? -difference : difference;
    const Int8 usable = at.inside & (grey == grey);  // the padding is NaN
    sum += usable ? size : Float8{};
    count += usable ? splat(1.0F) : Float8{};
  }
  const double num_pixels = sum_double(count);
  if (num_pixels < kLeastOverlap * static_cast<double>(size_)) {
    return kNan;
  }
  return sum_double(sum) / num_pixels;
}

}  // namespace plumb
