/// Where the rays of this image land in an older one, by the plane between them: eight at a time.
///
/// Frames  cam of the newest image; q = n / h [1/vo].  Units  pixels, undistorted ray coordinates (x, y, 1).
#pragma once

#include <Eigen/Core>

#include "modules/geometry/se3.hpp"
#include "modules/ground/lanes.hpp"
#include "modules/ground/road_pixels.hpp"
#include "modules/imaging/image_view.hpp"

namespace plumb {

inline Lanes splat(float v) { return Lanes{} + v; }

/// G = R + t q^T, and t, in float for the pixel loops.
struct Homography {
  float g[3][3];
  float t[3];
  /// Change of g per unit of y that a point has moved down since: the motion between its two rows is longer.
  float lag[3][3];  ///< only where `lags`
  bool lags;
};

/// @param lag_per_y  rolling shutter (row_clock.hpp): share of the motion that passes per unit of y
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
  // First order in the lag: the motion goes on as it was between the two images.
  const Eigen::Matrix3d lag =
      lag_per_y * (hat(log_so3(T_old_cam.R)) * G + T_old_cam.t * q.transpose());
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) h.lag[i][j] = static_cast<float>(lag(i, j));
  }
  return h;
}

/// Row of g or lag times the ray (x, y, 1).
inline Lanes times_ray(const float (&row)[3], const Lanes& x, const Lanes& y) {
  return row[0] * x + row[1] * y + row[2];
}

/// Where eight rays land in the older image.
struct Landing {
  Lanes xn;
  Lanes yn;
  Lanes inverse_depth;
  Lanes fu;         ///< fraction of the column
  Lanes fv;         ///< fraction of the row
  IntLanes column;  ///< clamped into the image
  IntLanes row;
  IntLanes inside;  ///< all ones where the pixels needed are in the image
};

/// @param reach_px  pixels that the sampling takes on each side of the 2x2 around the landing
inline void land(const Homography& h, const LevelCamera& camera, const ImageView& image,
                 const Lanes& x, const Lanes& y, int reach_px, Landing* out) {
  constexpr float kNearestDepth = 0.1F;
  constexpr int kRowIterations = 2;
  Lanes depth = times_ray(h.g[2], x, y);
  out->inverse_depth = 1.0F / depth;
  out->xn = times_ray(h.g[0], x, y) * out->inverse_depth;
  out->yn = times_ray(h.g[1], x, y) * out->inverse_depth;
  for (int i = 0; h.lags && i < kRowIterations; ++i) {
    const Lanes down = y - out->yn;
    depth = times_ray(h.g[2], x, y) + down * times_ray(h.lag[2], x, y);
    out->inverse_depth = 1.0F / depth;
    out->xn = (times_ray(h.g[0], x, y) + down * times_ray(h.lag[0], x, y)) * out->inverse_depth;
    out->yn = (times_ray(h.g[1], x, y) + down * times_ray(h.lag[1], x, y)) * out->inverse_depth;
  }
  const Lanes radial = camera.radial<Lanes>(out->xn * out->xn + out->yn * out->yn);
  const Lanes u = camera.fx * out->xn * radial + camera.cx;
  const Lanes v = camera.fy * out->yn * radial + camera.cy;
  const auto low = static_cast<float>(reach_px);
  const auto max_u = static_cast<float>(image.width_px - 1 - 2 * reach_px);
  const auto max_v = static_cast<float>(image.height_px - 1 - 2 * reach_px);
  out->inside = (depth > kNearestDepth) & (u >= low) & (u < max_u) & (v >= low) & (v < max_v);
  const Lanes safe_u = out->inside ? u : splat(low);
  const Lanes safe_v = out->inside ? v : splat(low);
  out->column = __builtin_convertvector(safe_u, IntLanes);
  out->row = __builtin_convertvector(safe_v, IntLanes);
  out->fu = safe_u - __builtin_convertvector(out->column, Lanes);
  out->fv = safe_v - __builtin_convertvector(out->row, Lanes);
}

}  // namespace plumb
