#include "modules/vo/patch.hpp"

#include <cmath>

namespace plumb::vo {
namespace {

constexpr std::ptrdiff_t kLanes = kNumLanes;  // bytes that become one vector of floats

// A patch whose grey values have a smaller variance shows noise.
constexpr float kMinVarianceGrey2 = 1.0F;
// A patch with a smaller ratio of determinant to squared trace shows a straight edge.
constexpr float kMinIsotropy = 1e-6F;
constexpr float kConvergedPx2 = 1e-4F;

// Interpolates a grey value. Coordinates have 8 fractional bits, the result has 16.
int bilinear_fixed(const ImageView& image, int u_fixed, int v_fixed) {
  const int fu = u_fixed & 255;
  const int fv = v_fixed & 255;
  const std::uint8_t* p = image.row(v_fixed >> 8) + (u_fixed >> 8);
  const std::uint8_t* q = p + image.stride_bytes;
  const int top = (p[0] << 8) + fu * (p[1] - p[0]);
  const int bottom = (q[0] << 8) + fu * (q[1] - q[0]);
  return (top << 8) + fv * (bottom - top);
}

// Returns false for NaN and for values beyond the range of int, because their conversion is
// undefined.
bool near_image(const ImageView& image, const Eigen::Vector2f& px) {
  return px.x() >= 0.0F && px.y() >= 0.0F && px.x() <= static_cast<float>(image.width_px) &&
         px.y() <= static_cast<float>(image.height_px);
}

[[gnu::always_inline]] inline Float8 lerp_bytes(const std::uint8_t* p, float f) {
  const Float8 left = load_bytes(p);
  return left + f * (load_bytes(p + 1) - left);
}

}  // namespace

// One for the lanes of a row's vector that belong to the template, zero for the padding.
template <int kHalf>
[[gnu::always_inline]] inline Float8 Patch<kHalf>::mask(int vector) {
  Float8 m;
  for (int i = 0; i < 8; ++i) m[i] = 8 * vector + i < kSize ? 1.0F : 0.0F;
  return m;
}

template <int kHalf>
bool Patch<kHalf>::cut(const ImageView& image, const Eigen::Vector2f& px) {
  if (!near_image(image, px)) return false;
  const int u0 = static_cast<int>(std::floor(px.x())) - kHalf - 1;
  const int v0 = static_cast<int>(std::floor(px.y())) - kHalf - 1;
  if (u0 < 0 || v0 < 0 || u0 + kRawSize >= image.width_px || v0 + kRawSize >= image.height_px) {
    return false;
  }
  const float fu = px.x() - std::floor(px.x());
  const float fv = px.y() - std::floor(px.y());
  alignas(32) Raw raw;
  Float8 top[kRawVectors];
  const std::uint8_t* p = image.row(v0) + u0;
  for (int k = 0; k < kRawVectors; ++k) top[k] = lerp_bytes(p + kLanes * k, fu);
  for (int j = 0; j < kRawSize; ++j) {
    p += image.stride_bytes;
    for (int k = 0; k < kRawVectors; ++k) {
      const Float8 bottom = lerp_bytes(p + kLanes * k, fu);
      store_floats(top[k] + fv * (bottom - top[k]), &raw[j][8 * k]);
      top[k] = bottom;
    }
  }
  return prepare(raw);
}

template <int kHalf>
bool Patch<kHalf>::cut(const ImageView& image, const Eigen::Vector2f& px,
                       const Eigen::Matrix2f& A) {
  // The corners of the template bound the parallelogram in the image.
  constexpr float kTemplateReach = kHalf + 1;
  const float reach_u = kTemplateReach * (std::abs(A(0, 0)) + std::abs(A(0, 1)));
  const float reach_v = kTemplateReach * (std::abs(A(1, 0)) + std::abs(A(1, 1)));
  if (!(px.x() - reach_u >= 1.0F && px.y() - reach_v >= 1.0F &&
        px.x() + reach_u <= static_cast<float>(image.width_px - 3) &&
        px.y() + reach_v <= static_cast<float>(image.height_px - 3))) {
    return false;
  }
  // Positions are in units of 2^-16 pixels, so that rounding errors do not add up along a row.
  constexpr float kFixed = 65536.0F;
  const auto du = static_cast<int>(A(0, 0) * kFixed);
  const auto dv = static_cast<int>(A(1, 0) * kFixed);
  alignas(32) Raw raw{};
  int grey[kRawSize];
  for (int j = 0; j < kRawSize; ++j) {
    const float y = static_cast<float>(j) - kTemplateReach;
    auto u = static_cast<int>((px.x() + A(0, 1) * y - A(0, 0) * kTemplateReach) * kFixed) + 128;
    auto v = static_cast<int>((px.y() + A(1, 1) * y - A(1, 0) * kTemplateReach) * kFixed) + 128;
    for (int i = 0; i < kRawSize; ++i, u += du, v += dv) {
      grey[i] = bilinear_fixed(image, u >> 8, v >> 8);
    }
    for (int i = 0; i < kRawSize; ++i) raw[j][i] = static_cast<float>(grey[i]) / kFixed;
  }
  return prepare(raw);
}

template <int kHalf>
bool Patch<kHalf>::prepare(const Raw& raw) {
  constexpr float kScale = 1.0F / kPixels;
  Float8 sum{};
  Float8 sum_x{};
  Float8 sum_y{};
  for (int j = 0; j < kSize; ++j) {
    for (int k = 0; k < kVectors; ++k) {
      const Float8 m = mask(k);
      // The last vector of a row extends beyond the template; the mask clears those lanes.
      const float* here = &raw[j + 1][8 * k];
      value_[j][k] = m * load_floats(here + 1);
      gx_[j][k] = m * 0.5F * (load_floats(here + 2) - load_floats(here));
      gy_[j][k] =
          m * 0.5F * (load_floats(&raw[j + 2][8 * k] + 1) - load_floats(&raw[j][8 * k] + 1));
      sum += value_[j][k];
      sum_x += gx_[j][k];
      sum_y += gy_[j][k];
    }
  }
  mean_ = sum_float(sum) * kScale;
  const float mean_x = sum_float(sum_x) * kScale;
  const float mean_y = sum_float(sum_y) * kScale;
  Float8 tt{}, xx{}, xy{}, yy{}, xt{}, yt{};
  for (int j = 0; j < kSize; ++j) {
    for (int k = 0; k < kVectors; ++k) {
      const Float8 m = mask(k);
      const Float8 t = value_[j][k] = value_[j][k] - m * mean_;
      const Float8 x = gx_[j][k] = gx_[j][k] - m * mean_x;
      const Float8 y = gy_[j][k] = gy_[j][k] - m * mean_y;
      tt += t * t;
      xx += x * x;
      xy += x * y;
      yy += y * y;
      xt += x * t;
      yt += y * t;
    }
  }
  tt_ = sum_float(tt);
  a_ = sum_float(xx);
  b_ = sum_float(xy);
  c_ = sum_float(yy);
  gxt_ = sum_float(xt);
  gyt_ = sum_float(yt);
  det_ = a_ * c_ - b_ * b_;
  return tt_ > kMinVarianceGrey2 * kPixels && det_ > kMinIsotropy * (a_ + c_) * (a_ + c_);
}

template <int kHalf>
typename Patch<kHalf>::Sums Patch<kHalf>::compare(const std::uint8_t* corner, std::ptrdiff_t stride,
                                                  float fu, float fv) const {
  Float8 p{}, pp{}, pt{}, px{}, py{};
  Float8 top[kVectors];
  for (int k = 0; k < kVectors; ++k) top[k] = lerp_bytes(corner + kLanes * k, fu);
  for (int j = 0; j < kSize; ++j) {
    corner += stride;
    for (int k = 0; k < kVectors; ++k) {
      const Float8 bottom = lerp_bytes(corner + kLanes * k, fu);
      const Float8 v = mask(k) * (top[k] + fv * (bottom - top[k]) - mean_);
      top[k] = bottom;
      p += v;
      pp += v * v;
      pt += v * value_[j][k];
      px += v * gx_[j][k];
      py += v * gy_[j][k];
    }
  }
  return {sum_float(p), sum_float(pp), sum_float(pt), sum_float(px), sum_float(py)};
}

template <int kHalf>
Alignment Patch<kHalf>::align(const ImageView& image, const Eigen::Vector2f& start,
                              const AlignLimits& limits) const {
  Alignment result;
  Eigen::Vector2f px = start;
  float ncc = -1.0F;
  for (int i = 0; i < limits.max_iterations; ++i) {
    if (!near_image(image, px)) return result;
    const float u = std::floor(px.x());
    const float v = std::floor(px.y());
    const int u0 = static_cast<int>(u) - kHalf;
    const int v0 = static_cast<int>(v) - kHalf;
    if (!(u0 >= 0 && v0 >= 0 && u0 + kSize < image.width_px && v0 + kSize < image.height_px)) {
      return result;
    }
    const Sums s = compare(image.row(v0) + u0, image.stride_bytes, px.x() - u, px.y() - v);
    const float pp = s.pp - s.p * s.p * (1.0F / kPixels);
    if (!(pp > 0.0F)) return result;
    ncc = s.pt / std::sqrt(pp * tt_);
    const float gain = s.pt / tt_;
    if (!(gain >= limits.min_gain)) return result;
    const float bx = s.px / gain - gxt_;
    const float by = s.py / gain - gyt_;
    const Eigen::Vector2f step((c_ * bx - b_ * by) / det_, (a_ * by - b_ * bx) / det_);
    px -= step;
    if (!((px - start).squaredNorm() <= limits.max_shift_px * limits.max_shift_px)) return result;
    if (step.squaredNorm() < kConvergedPx2) break;
  }
  result.px = px;
  result.ncc = ncc;
  return result;
}

template class Patch<5>;
template class Patch<7>;

}  // namespace plumb::vo
