#include "modules/ground/cues/road_pixels.hpp"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

constexpr int kBorderPx = 2;

struct RowSpan {
  int begin = 0;
  int end = 0;
};

/// Returns the columns of row `v` that lie on the path; empty beyond the far and near ends.
RowSpan span_of_row(int v, const ImageView& image, const LevelCamera& camera,
                    const RoadShape& shape, const Eigen::Vector3d& q) {
  const double h = 1.0 / q.norm();
  const double y =
      (static_cast<double>(v) - static_cast<double>(camera.cy)) / static_cast<double>(camera.fy);
  const double inverse_depth = q.y() * y + q.z();
  if (inverse_depth * shape.far_ratio * h < 1.0) return {};
  const double depth = 1.0 / inverse_depth;
  if (depth < shape.near_ratio * h) return {};
  const double centre = 0.5 * shape.curvature * depth * depth;
  const double half = shape.half_width_ratio * h;
  const auto column = [&](double lateral) {
    return static_cast<double>(camera.cx) + static_cast<double>(camera.fx) * lateral / depth;
  };
  const double low = std::max<double>(kBorderPx, column(centre - half));
  const double high = std::min<double>(image.width_px - 1 - kBorderPx, column(centre + half));
  if (high <= low) return {};
  return {static_cast<int>(low), static_cast<int>(high)};
}

/// Inverts the radial terms by fixed-point iteration, accurate to 1e-6 where they move a pixel by
/// less than 5 %.
void undistort(const LevelCamera& camera, RoadPixels* pixels) {
  for (int i = 0; i < pixels->size; ++i) {
    const float xd = pixels->x[i];
    const float yd = pixels->y[i];
    float s = 1.0F;
    for (int k = 0; k < 4; ++k) {
      const float x = xd * s;
      const float y = yd * s;
      s = 1.0F / camera.radial(x * x + y * y);
    }
    pixels->x[i] = xd * s;
    pixels->y[i] = yd * s;
  }
}

}  // namespace

LevelCamera camera_of_level(const CameraModel& camera, int level) {
  const double scale = 1.0 / static_cast<double>(1 << level);
  // Pixel centres move with 2x2 averages: u_l = (u_0 + 0.5) / 2^l - 0.5.
  return {static_cast<float>(camera.fx_px * scale),
          static_cast<float>(camera.fy_px * scale),
          static_cast<float>((camera.cx_px + 0.5) * scale - 0.5),
          static_cast<float>((camera.cy_px + 0.5) * scale - 0.5),
          static_cast<float>(camera.residual_k1),
          static_cast<float>(camera.residual_k2)};
}

void select_road_pixels(const ImageView& image, const LevelCamera& camera, const RoadShape& shape,
                        const Eigen::Vector3d& q, int max_pixels, RoadPixels* pixels) {
  int area = 0;
  for (int v = kBorderPx; v < image.height_px - kBorderPx; ++v) {
    const RowSpan span = span_of_row(v, image, camera, shape, q);
    area += span.end - span.begin;
  }
  const double spacing = std::sqrt(static_cast<double>(area) / max_pixels);
  const int row_step = std::max(1, static_cast<int>(spacing));
  const int column_step = std::max(1, (area + max_pixels * row_step - 1) / (max_pixels * row_step));

  int n = 0;
  for (int v = kBorderPx; v < image.height_px - kBorderPx; v += row_step) {
    const RowSpan span = span_of_row(v, image, camera, shape, q);
    const std::uint8_t* row = image.row(v);
    for (int u = span.begin; u < span.end && n < max_pixels; u += column_step, ++n) {
      pixels->x[n] = (static_cast<float>(u) - camera.cx) / camera.fx;
      pixels->y[n] = (static_cast<float>(v) - camera.cy) / camera.fy;
      pixels->grey[n] = static_cast<float>(row[u]);
    }
  }
  pixels->size = n;
  undistort(camera, pixels);
  for (int i = n; i < pixels->padded_size(); ++i) {
    pixels->x[i] = pixels->y[i] = pixels->grey[i] = 0.0F;
  }
}

}  // namespace plumb
