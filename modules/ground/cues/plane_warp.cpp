#include "modules/ground/cues/plane_warp.hpp"

#include <array>
#include <cmath>
#include <cstring>

#include "core/simd.hpp"
#include "modules/ground/cues/homography_warp.hpp"

namespace plumb {
namespace {

// Degrees of freedom of the residuals' Student-t distribution: w = (nu + 1) / (nu + r^2 / sigma^2).
constexpr float kResidualNu = 5.0F;
constexpr int kReach_px = 1;  // for the central differences

/// Byte `k` of each little-endian word as float.
template <int k>
inline void byte_of(const Int8& words, Float8* out) {
  *out = __builtin_convertvector((words >> (8 * k)) & 0xff, Float8);
}

/// Bilinear value and central differences.
struct Sample {
  Float8 value;
  Float8 du;
  Float8 dv;
};

inline void gather_row(const ImageView& image, const WarpedRays& at, int row_offset, Int8* words) {
  for (int lane = 0; lane < kNumLanes; ++lane) {
    const std::uint8_t* from = image.row(at.row[lane] + row_offset) + at.column[lane] - 1;
    std::int32_t word = 0;
    std::memcpy(&word, from, sizeof(word));
    (*words)[lane] = word;
  }
}

/// Values at u - 1, u and u + 1, interpolated between columns.
struct RowSample {
  Float8 left;
  Float8 centre;
  Float8 right;
};

inline void sample_row(const ImageView& image, const WarpedRays& at, int row_offset,
                       RowSample* out) {
  Int8 words{};
  gather_row(image, at, row_offset, &words);
  Float8 c0, c1, c2, c3;
  byte_of<0>(words, &c0);
  byte_of<1>(words, &c1);
  byte_of<2>(words, &c2);
  byte_of<3>(words, &c3);
  out->left = c0 + at.fu * (c1 - c0);
  out->centre = c1 + at.fu * (c2 - c1);
  out->right = c2 + at.fu * (c3 - c2);
}

inline void sample_with_gradient(const ImageView& image, const WarpedRays& at, Sample* out) {
  RowSample above{}, upper{}, lower{}, below{};
  sample_row(image, at, -1, &above);
  sample_row(image, at, 0, &upper);
  sample_row(image, at, 1, &lower);
  sample_row(image, at, 2, &below);
  out->value = upper.centre + at.fv * (lower.centre - upper.centre);
  const Float8 slope_upper = upper.right - upper.left;
  const Float8 slope_lower = lower.right - lower.left;
  out->du = 0.5F * (slope_upper + at.fv * (slope_lower - slope_upper));
  const Float8 rise_upper = lower.centre - above.centre;
  const Float8 rise_lower = below.centre - upper.centre;
  out->dv = 0.5F * (rise_upper + at.fv * (rise_lower - rise_upper));
}

inline void sample_value(const ImageView& image, const WarpedRays& at, Float8* out) {
  RowSample upper{}, lower{};
  sample_row(image, at, 0, &upper);
  sample_row(image, at, 1, &lower);
  *out = upper.centre + at.fv * (lower.centre - upper.centre);
}

/// Marks the lanes of the block at `i` that belong to a pixel.
inline Int8 lanes_in_use(int i, int size) {
  const Int8 index = Int8{0, 1, 2, 3, 4, 5, 6, 7} + i;
  return index < (Int8{} + size);
}

/// The twenty sums of the normal equations; J = (g x, g y, g, -I, -1).
struct LaneSums {
  Float8 hxx{}, hxy{}, hyy{}, hx{}, hy{}, h1{};    // q with q, each times g^2
  Float8 hix{}, hiy{}, hi{}, h1x{}, h1y{}, h11{};  // q with gain, q with bias
  Float8 hii{}, hi1{}, hww{};                      // gain, bias
  Float8 bx{}, by{}, b1{}, bi{}, bb{};
  Float8 square{}, count{};

  void add(const Float8& x, const Float8& y, const Float8& grey, const Float8& g, const Float8& r,
           const Float8& w) {
    const Float8 wg = w * g, wgg = wg * g, wr = w * r, wgr = wg * r;
    const Float8 wggx = wgg * x, wggy = wgg * y, wgi = wg * grey, wi = w * grey;
    hxx += wggx * x, hxy += wggx * y, hyy += wggy * y, hx += wggx, hy += wggy, h1 += wgg;
    hix += wgi * x, hiy += wgi * y, hi += wgi, h1x += wg * x, h1y += wg * y, h11 += wg;
    hii += wi * grey, hi1 += wi, hww += w;
    bx += wgr * x, by += wgr * y, b1 += wgr, bi += wr * grey, bb += wr;
    square += wr * r;
  }

  void write(PairSums* out) const {
    auto& H = out->H;
    H(0, 0) = sum_double(hxx), H(0, 1) = sum_double(hxy), H(0, 2) = sum_double(hx);
    H(1, 1) = sum_double(hyy), H(1, 2) = sum_double(hy), H(2, 2) = sum_double(h1);
    H(0, 3) = -sum_double(hix), H(1, 3) = -sum_double(hiy), H(2, 3) = -sum_double(hi);
    H(0, 4) = -sum_double(h1x), H(1, 4) = -sum_double(h1y), H(2, 4) = -sum_double(h11);
    H(3, 3) = sum_double(hii), H(3, 4) = sum_double(hi1), H(4, 4) = sum_double(hww);
    for (int i = 0; i < kNumPairParams; ++i) {
      for (int j = 0; j < i; ++j) H(i, j) = H(j, i);
    }
    out->b << -sum_double(bx), -sum_double(by), -sum_double(b1), sum_double(bi), sum_double(bb);
    out->weighted_square = sum_double(square);
    out->num_pixels = static_cast<int>(std::lround(sum_double(count)));
  }
};

}  // namespace

PlaneWarp::PlaneWarp(const ImageView& old_image, const LevelCamera& camera, const Se3& T_old_cam,
                     double lag_per_y)
    : image_(old_image), camera_(camera), T_old_cam_(T_old_cam), lag_per_y_(lag_per_y) {}

void PlaneWarp::accumulate(const RoadPixels& pixels, const Eigen::Vector3d& q,
                           const Photometric& photometric, double sigma_grey,
                           PairSums* sums) const {
  const Homography h = make_homography(T_old_cam_, q, lag_per_y_);
  const float gain = static_cast<float>(1.0 + photometric.gain);
  const float bias = static_cast<float>(photometric.bias);
  const float inverse_var = static_cast<float>(1.0 / (sigma_grey * sigma_grey));
  LaneSums lanes;
  for (int i = 0; i < pixels.size; i += kNumLanes) {
    Float8 x, y, grey;
    x = load_floats(pixels.x + i);
    y = load_floats(pixels.y + i);
    grey = load_floats(pixels.grey + i);
    WarpedRays at{};
    warp_rays(h, camera_, image_, x, y, kReach_px, &at);
    Sample old{};
    sample_with_gradient(image_, at, &old);
    const Float8 r = old.value - gain * grey - bias;
    // Chain rule along the epipolar line. The slopes of the radial term, below 1 %, and of the
    // rolling shutter are neglected; iteration corrects for them.
    const Float8 g = at.inverse_depth * (camera_.fx * old.du * (h.t[0] - at.xn * h.t[2]) +
                                         camera_.fy * old.dv * (h.t[1] - at.yn * h.t[2]));
    const Int8 usable = at.inside & lanes_in_use(i, pixels.size);
    const Float8 w =
        usable ? (kResidualNu + 1.0F) / (kResidualNu + r * r * inverse_var) : splat(0.0F);
    lanes.add(x, y, grey, usable ? g : splat(0.0F), r, w);
    lanes.count += usable ? splat(1.0F) : splat(0.0F);
  }
  lanes.write(sums);
}

Likeness PlaneWarp::compare(const RoadPixels& pixels, const Eigen::Vector3d& q) const {
  const Homography h = make_homography(T_old_cam_, q, lag_per_y_);
  alignas(32) std::array<float, kMaxRoadPixels + kNumLanes> difference{};
  Float8 count{}, sum_a{}, sum_b{}, sum_aa{}, sum_bb{}, sum_ab{};
  const Float8 zero{};
  for (int i = 0; i < pixels.size; i += kNumLanes) {
    Float8 x, y, grey, old;
    x = load_floats(pixels.x + i);
    y = load_floats(pixels.y + i);
    grey = load_floats(pixels.grey + i);
    WarpedRays at{};
    warp_rays(h, camera_, image_, x, y, kReach_px, &at);
    sample_value(image_, at, &old);
    const Int8 usable = at.inside & lanes_in_use(i, pixels.size);
    const Float8 a = usable ? old : zero;
    const Float8 b = usable ? grey : zero;
    count += usable ? splat(1.0F) : zero;
    sum_a += a, sum_b += b, sum_aa += a * a, sum_bb += b * b, sum_ab += a * b;
    store_floats(usable ? old - grey : splat(std::nanf("")), difference.data() + i);
  }
  Likeness out;
  out.num_pixels = static_cast<int>(std::lround(sum_double(count)));
  if (out.num_pixels == 0) return out;
  const double n = out.num_pixels;
  const double mean_a = sum_double(sum_a) / n;
  const double mean_b = sum_double(sum_b) / n;
  const float mean = static_cast<float>(mean_a - mean_b);
  Float8 absolute{};
  for (int i = 0; i < pixels.size; i += kNumLanes) {
    Float8 d;
    d = load_floats(difference.data() + i);
    const Float8 centred = d - mean;
    const Float8 size = centred < 0.0F ? -centred : centred;
    absolute += (d == d) ? size : zero;
  }
  out.sad = sum_double(absolute) / n;
  const double var_a = sum_double(sum_aa) / n - mean_a * mean_a;
  const double var_b = sum_double(sum_bb) / n - mean_b * mean_b;
  const double cov = sum_double(sum_ab) / n - mean_a * mean_b;
  out.ncc = cov / std::sqrt(var_a * var_b + 1e-9);
  return out;
}

}  // namespace plumb
