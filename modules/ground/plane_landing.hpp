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
};

inline Homography make_homography(const Se3& T_old_cam, const Eigen::Vector3d& q) {
  const Eigen::Matrix3d G = T_old_cam.R + T_old_cam.t * q.transpose();
  Homography h{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) h.g[i][j] = static_cast<float>(G(i, j));
    h.t[i] = static_cast<float>(T_old_cam.t(i));
  }
  return h;
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
  const Lanes depth = h.g[2][0] * x + h.g[2][1] * y + h.g[2][2];
  out->inverse_depth = 1.0F / depth;
  out->xn = (h.g[0][0] * x + h.g[0][1] * y + h.g[0][2]) * out->inverse_depth;
  out->yn = (h.g[1][0] * x + h.g[1][1] * y + h.g[1][2]) * out->inverse_depth;
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
