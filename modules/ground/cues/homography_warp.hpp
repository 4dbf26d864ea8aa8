/// Warps rays of this image into an older one by the homography of a plane, eight at a time.
///
/// Frames:
///   cam of the newest image; q = n / h [1/vo].
/// Units:
///   Pixels; undistorted ray coordinates (x, y, 1).
#pragma once

#include <Eigen/Core>

#include "core/image_view.hpp"
#include "core/se3.hpp"
#include "core/simd.hpp"
#include "modules/ground/cues/road_pixels.hpp"

namespace plumb {

inline Float8 splat(float v) { return Float8{} + v; }

/// The homography G = R + t q^T of a plane (Song and Chandraker, CVPR 2014, equation (6), for a
/// normal that points down), and t, in float for the pixel loops.
struct Homography {
  float g[3][3];
  float t[3];
  /// Change of g per unit of y that a point moved down between the images: with a rolling shutter,
  /// more time passes between its two rows. Valid only if `lags`.
  float lag[3][3];
  bool lags;
};

/// @param lag_per_y  RowClock::lag_per_y(); 0 for a global shutter
inline Homography make_homography(const Se3& T_old_cam, const Eigen::Vector3d& q,
                                  double lag_per_y = 0.0) {
  const Eigen::Matrix3d G = T_old_cam.R + T_old_cam.t * q.transpose();
  Homography h{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) h.g[i][j] = static_cast<float>(G(i, j));
    h.t[i] = static_cast<float>(T_old_cam.t(i));
  }
  h.lags = lag_per_y != 0.0;
  if (!h.lags) return h;
  // First order in the lag: the camera keeps the velocity that it had between the two images.
  const Eigen::Matrix3d lag =
      lag_per_y * (hat(log_so3(T_old_cam.R)) * G + T_old_cam.t * q.transpose());
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) h.lag[i][j] = static_cast<float>(lag(i, j));
  }
  return h;
}

/// Returns a row of g or lag times the ray (x, y, 1).
inline Float8 times_ray(const float (&row)[3], const Float8& x, const Float8& y) {
  return row[0] * x + row[1] * y + row[2];
}

/// Eight rays in the older image.
struct WarpedRays {
  Float8 xn;
  Float8 yn;
  Float8 inverse_depth;
  Float8 fu;    ///< fraction of the column
  Float8 fv;    ///< fraction of the row
  Int8 column;  ///< clamped into the image
  Int8 row;
  Int8 inside;  ///< all ones where the pixels needed are in the image
};

/// @param reach_px  pixels that the sampling needs on each side of the 2x2 around the warped ray
inline void warp_rays(const Homography& h, const LevelCamera& camera, const ImageView& image,
                      const Float8& x, const Float8& y, int reach_px, WarpedRays* out) {
  constexpr float kNearestDepth = 0.1F;
  constexpr int kRowIterations = 2;
  Float8 depth = times_ray(h.g[2], x, y);
  out->inverse_depth = 1.0F / depth;
  out->xn = times_ray(h.g[0], x, y) * out->inverse_depth;
  out->yn = times_ray(h.g[1], x, y) * out->inverse_depth;
  for (int i = 0; h.lags && i < kRowIterations; ++i) {
    const Float8 down = y - out->yn;
    depth = times_ray(h.g[2], x, y) + down * times_ray(h.lag[2], x, y);
    out->inverse_depth = 1.0F / depth;
    out->xn = (times_ray(h.g[0], x, y) + down * times_ray(h.lag[0], x, y)) * out->inverse_depth;
    out->yn = (times_ray(h.g[1], x, y) + down * times_ray(h.lag[1], x, y)) * out->inverse_depth;
  }
  const Float8 radial = camera.radial<Float8>(out->xn * out->xn + out->yn * out->yn);
  const Float8 u = camera.fx * out->xn * radial + camera.cx;
  const Float8 v = camera.fy * out->yn * radial + camera.cy;
  const auto low = static_cast<float>(reach_px);
  const auto max_u = static_cast<float>(image.width_px - 1 - 2 * reach_px);
  const auto max_v = static_cast<float>(image.height_px - 1 - 2 * reach_px);
  out->inside = (depth > kNearestDepth) & (u >= low) & (u < max_u) & (v >= low) & (v < max_v);
  const Float8 safe_u = out->inside ? u : splat(low);
  const Float8 safe_v = out->inside ? v : splat(low);
  out->column = __builtin_convertvector(safe_u, Int8);
  out->row = __builtin_convertvector(safe_v, Int8);
  out->fu = safe_u - __builtin_convertvector(out->column, Float8);
  out->fv = safe_v - __builtin_convertvector(out->row, Float8);
}

}  // namespace plumb
