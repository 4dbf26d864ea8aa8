/// A square template and its sub-pixel alignment to an image.
///
/// Inverse-compositional translation, blind to gain and offset: with T and its gradients G made zero-mean, the
/// step solves  (sum G G^T) d = sum G (P / g - T),  g = sum(P T) / sum(T T), and the offset drops out.
///
/// Frames   img, at any pyramid level.  Memory in place; rows are padded to whole vectors.
#pragma once

#include <Eigen/Core>

#include "core/image_view.hpp"
#include "core/simd.hpp"

namespace plumb::vo {

struct Alignment {
  Eigen::Vector2f px = Eigen::Vector2f::Zero();
  float ncc = -1.0F;  ///< correlation at px; -1 when the alignment failed
  [[nodiscard]] bool ok() const { return ncc > -1.0F; }
};

struct AlignLimits {
  int max_iterations = 12;
  float max_shift_px = 3.0F;  ///< from the start
  float min_gain = 0.3F;      ///< lower contrast than this share of the template's is a failure
};

/// (2 kHalf + 1)^2 pixels around a point.
template <int kHalf>
class Patch {
 public:
  static constexpr int kSize = 2 * kHalf + 1;
  static constexpr int kVectors = (kSize + 7) / 8;

  /// Cuts the template around `px`. False when it leaves the image or has no corner in it.
  [[nodiscard]] bool cut(const ImageView& image, const Eigen::Vector2f& px);

  /// The same with offsets mapped by `A` (offset in the search image -> offset in `image`).
  [[nodiscard]] bool cut(const ImageView& image, const Eigen::Vector2f& px,
                         const Eigen::Matrix2f& A);

  /// Finds the template in `image` near `start`.
  [[nodiscard]] Alignment align(const ImageView& image, const Eigen::Vector2f& start,
                                const AlignLimits& limits) const;

 private:
  static constexpr int kPixels = kSize * kSize;
  static constexpr int kRawSize = kSize + 2;        // one pixel of border for the gradients
  static constexpr int kRawVectors = kVectors + 1;  // so that shifted loads stay inside a row
  using Raw = float[kRawSize][8 * kRawVectors];

  struct Sums {
    float p, pp, pt, px, py;
  };

  static Float8 mask(int vector);
  bool prepare(const Raw& raw);
  Sums compare(const std::uint8_t* corner, std::ptrdiff_t stride, float fu, float fv) const;

  alignas(32) Float8 value_[kSize][kVectors];
  alignas(32) Float8 gx_[kSize][kVectors];
  alignas(32) Float8 gy_[kSize][kVectors];
  float mean_ = 0.0F;
  float tt_ = 0.0F;                // sum T T
  float gxt_ = 0.0F, gyt_ = 0.0F;  // sum G T
  float a_ = 0.0F, b_ = 0.0F, c_ = 0.0F, det_ = 0.0F;
};

extern template class Patch<3>;
extern template class Patch<5>;
extern template class Patch<7>;

}  // namespace plumb::vo
