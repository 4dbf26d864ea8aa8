#include "modules/ground/paper/road_region.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "modules/ground/lanes.hpp"

namespace plumb {
namespace {

constexpr float kNearestDepth = 0.1F;
constexpr double kLeastOverlap = 0.5;

inline Lanes splat(float v) { return Lanes{} + v; }

/// Rows of the homography and lens of the older image, in float.
struct Warp {
  float g[3][3];
  float fx, fy, cx, cy, k1, k2;
};

Warp make_warp(const CameraModel& camera, const Se3& T_old_cam, const Eigen::Vector3d& q) {
  const Eigen::Matrix3d G = T_old_cam.R + T_old_cam.t * q.transpose();
  Warp w{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) w.g[i][j] = static_cast<float>(G(i, j));
  }
  w.fx = static_cast<float>(camera.fx_px);
  w.fy = static_cast<float>(camera.fy_px);
  w.cx = static_cast<float>(camera.cx_px);
  w.cy = static_cast<float>(camera.cy_px);
  w.k1 = static_cast<float>(camera.residual_k1);
  w.k2 = static_cast<float>(camera.residual_k2);
  return w;
}

/// Where eight rays land, clamped into the image; `inside` is all ones where they did.
struct Landing {
  Lanes fu, fv;
  IntLanes column, row, inside;
};

inline void land(const Warp& w, const ImageView& image, const Lanes& x, const Lanes& y,
                 Landing* at) {
  const Lanes depth = w.g[2][0] * x + w.g[2][1] * y + w.g[2][2];
  const Lanes inverse = 1.0F / depth;
  const Lanes xn = (w.g[0][0] * x + w.g[0][1] * y + w.g[0][2]) * inverse;
  const Lanes yn = (w.g[1][0] * x + w.g[1][1] * y + w.g[1][2]) * inverse;
  const Lanes r2 = xn * xn + yn * yn;
  const Lanes radial = 1.0F + r2 * (w.k1 + r2 * w.k2);
  const Lanes u = w.fx * xn * radial + w.cx;
  const Lanes v = w.fy * yn * radial + w.cy;
  const auto max_u = static_cast<float>(image.width_px - 1);
  const auto max_v = static_cast<float>(image.height_px - 1);
  at->inside = (depth > kNearestDepth) & (u >= 0.0F) & (u < max_u) & (v >= 0.0F) & (v < max_v);
  const Lanes safe_u = at->inside ? u : splat(0.0F);
  const Lanes safe_v = at->inside ? v : splat(0.0F);
  at->column = __builtin_convertvector(safe_u, IntLanes);
  at->row = __builtin_convertvector(safe_v, IntLanes);
  at->fu = safe_u - __builtin_convertvector(at->column, Lanes);
  at->fv = safe_v - __builtin_convertvector(at->row, Lanes);
}

/// Interpolates along u in the row `row_offset` below the landing.
inline void sample_row(const ImageView& image, const Landing& at, int row_offset, Lanes* out) {
  IntLanes words{};
  for (int lane = 0; lane < kLanes; ++lane) {
    std::uint16_t pair = 0;
    std::memcpy(&pair, image.row(at.row[lane] + row_offset) + at.column[lane], sizeof(pair));
    words[lane] = pair;
  }
  const Lanes left = __builtin_convertvector(words & 0xff, Lanes);
  const Lanes right = __builtin_convertvector(words >> 8, Lanes);
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
  const std::size_t padded = (size_ + kLanes - 1) / kLanes * kLanes;
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
  const Warp warp = make_warp(camera_, T_old_cam, q);
  Lanes sum{}, count{};
  for (std::size_t i = 0; i < grey_.size(); i += kLanes) {
    Lanes x, y, grey, upper, lower;
    load(x_.data() + i, &x);
    load(y_.data() + i, &y);
    load(grey_.data() + i, &grey);
    Landing at{};
    land(warp, old_image, x, y, &at);
    sample_row(old_image, at, 0, &upper);
    sample_row(old_image, at, 1, &lower);
    const Lanes difference = upper + at.fv * (lower - upper) - grey;
    const Lanes size = difference < 0.0F ? -difference : difference;
    const IntLanes usable = at.inside & (grey == grey);  // the padding is NaN
    sum += usable ? size : Lanes{};
    count += usable ? splat(1.0F) : Lanes{};
  }
  const double num_pixels = sum_lanes(count);
  if (num_pixels < kLeastOverlap * static_cast<double>(size_)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return sum_lanes(sum) / num_pixels;
}

}  // namespace plumb
