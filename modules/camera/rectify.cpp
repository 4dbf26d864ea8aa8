#include "modules/camera/rectify.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "modules/camera/convert.hpp"

namespace plumb {
namespace {

struct Point {
  double x;
  double y;
};

Point distort_plumb_bob(const Lens& lens, double x, double y) {
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  return {x * radial + 2.0 * lens.p1 * x * y + lens.p2 * (r2 + 2.0 * x * x),
          y * radial + lens.p1 * (r2 + 2.0 * y * y) + 2.0 * lens.p2 * x * y};
}

Point distort_fisheye(const Lens& lens, double x, double y) {
  const double r = std::sqrt(x * x + y * y);
  if (r < 1e-12) return {x, y};
  const double theta = std::atan(r);
  const double t2 = theta * theta;
  const double series = 1.0 + t2 * (lens.k1 + t2 * (lens.k2 + t2 * (lens.k3 + t2 * lens.k4)));
  const double scale = theta * series / r;
  return {x * scale, y * scale};
}

/// Derivative of the distorted radius with respect to the undistorted one (fisheye: to the angle).
double radial_slope(const Lens& lens, double r) {
  const bool is_fisheye = lens.model == LensModel::kFisheye;
  const double s = is_fisheye ? std::atan(r) : r;
  const double s2 = s * s;
  const double k4 = is_fisheye ? lens.k4 : 0.0;
  const double k123 = 3.0 * lens.k1 + s2 * (5.0 * lens.k2 + s2 * (7.0 * lens.k3 + s2 * 9.0 * k4));
  return 1.0 + s2 * k123;
}

/// The radius at which the polynomial folds over. Beyond it two rays share a pixel, and the lens
/// model is not valid.
double fold_radius(const Lens& lens, double r_max) {
  constexpr int kSteps = 4096;
  for (int i = 1; i <= kSteps; ++i) {
    const double r = r_max * i / kSteps;
    if (radial_slope(lens, r) <= 0.0) return r_max * (i - 1) / kSteps;
  }
  return r_max;
}

bool same(const PinholePx& a, const PinholePx& b) {
  return a.fx_px == b.fx_px && a.fy_px == b.fy_px && a.cx_px == b.cx_px && a.cy_px == b.cy_px;
}

bool is_undistorted(const Lens& lens) {
  return lens.model == LensModel::kPlumbBob && lens.k1 == 0.0 && lens.k2 == 0.0 && lens.p1 == 0.0 &&
         lens.p2 == 0.0 && lens.k3 == 0.0;
}

}  // namespace

Rectifier::Rectifier(int width_px, int height_px, const PinholePx& captured, const Lens& lens,
                     const PinholePx& published)
    : width_px_(width_px),
      height_px_(height_px),
      identity_(is_undistorted(lens) && same(captured, published)),
      unseen_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), 0) {
  if (identity_) return;
  const double x_max = std::max(published.cx_px, width_px - published.cx_px) / published.fx_px;
  const double y_max = std::max(published.cy_px, height_px - published.cy_px) / published.fy_px;
  const double r_fold = fold_radius(lens, std::sqrt(x_max * x_max + y_max * y_max));
  taps_.reserve(unseen_.size());
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const double x = (u - published.cx_px) / published.fx_px;
      const double y = (v - published.cy_px) / published.fy_px;
      const Point d = lens.model == LensModel::kFisheye ? distort_fisheye(lens, x, y)
                                                        : distort_plumb_bob(lens, x, y);
      const double u_in = captured.fx_px * d.x + captured.cx_px;
      const double v_in = captured.fy_px * d.y + captured.cy_px;
      const bool inside =
          u_in >= 0.0 && v_in >= 0.0 && u_in <= width_px - 1 && v_in <= height_px - 1;
      const bool seen = inside && x * x + y * y <= r_fold * r_fold;
      unseen_[taps_.size()] = seen ? 0 : 1;
      taps_.push_back(tap_for(u_in, v_in));
    }
  }
}

Rectifier::Tap Rectifier::tap_for(double u_px, double v_px) const {
  const double u_clamped = std::clamp(u_px, 0.0, static_cast<double>(width_px_ - 1));
  const double v_clamped = std::clamp(v_px, 0.0, static_cast<double>(height_px_ - 1));
  // The last column is reached from its neighbour with weight 256, so that no tap reads outside.
  const int u = std::min(static_cast<int>(u_clamped), width_px_ - 2);
  const int v = std::min(static_cast<int>(v_clamped), height_px_ - 2);
  return {static_cast<std::int16_t>(u), static_cast<std::int16_t>(v),
          static_cast<std::uint16_t>(std::lround((u_clamped - u) * 256.0)),
          static_cast<std::uint16_t>(std::lround((v_clamped - v) * 256.0))};
}

void Rectifier::apply(const ImageView& captured, std::uint8_t* out) const {
  if (identity_) {
    copy_rows(captured, out);
    return;
  }
  const Tap* tap = taps_.data();
  const Tap* const end = tap + taps_.size();
  for (; tap != end; ++tap, ++out) {
    const std::uint8_t* p = captured.data + tap->v * captured.stride_bytes + tap->u;
    const std::uint8_t* q = p + captured.stride_bytes;
    // One multiplication serves both rows: the upper row is in bits 0 to 15, the lower in 16 to 31,
    // and 255 * 256 fits into 16 bits.
    const std::uint32_t left = p[0] | static_cast<std::uint32_t>(q[0]) << 16;
    const std::uint32_t right = p[1] | static_cast<std::uint32_t>(q[1]) << 16;
    const std::uint32_t rows = left * (256U - tap->wu) + right * tap->wu;
    const std::uint32_t sum = (rows & 0xFFFFU) * (256U - tap->wv) + (rows >> 16) * tap->wv;
    *out = static_cast<std::uint8_t>((sum + 32768U) >> 16);
  }
}

}  // namespace plumb
