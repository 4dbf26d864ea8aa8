/// A square template and its alignment to an image with sub-pixel accuracy.
///
/// The alignment is the inverse compositional algorithm for translations (Baker & Matthews,
/// "Lucas-Kanade 20 Years On", 2004), invariant to gain and offset. Template T and gradients G have
/// zero mean. With the image patch P, one step d solves
///   (sum G G^T) d = sum G (P / g - T),  g = sum(P T) / sum(T T).
/// The offset of P has no effect, because the sum of G is zero.
///
/// Frames:
///   img, on any level of a pyramid.
/// Memory:
///   In place. Rows are padded to whole vectors of eight floats.
#pragma once

#include <Eigen/Core>

#include "core/image_view.hpp"
#include "core/simd.hpp"

namespace plumb::vo {

struct Alignment {
  Eigen::Vector2f px = Eigen::Vector2f::Zero();
  float ncc = -1.0F;  ///< normalised cross-correlation before the last step; -1 after a failure
  [[nodiscard]] bool ok() const { return ncc > -1.0F; }
};

struct AlignLimits {
  int max_iterations = 12;
  float max_shift_px = 3.0F;  ///< distance from the start
  float min_gain = 0.3F;      ///< ratio of the image's contrast to the template's
};

/// A template of (2 kHalf + 1)^2 pixels around a point.
template <int kHalf>
class Patch {
 public:
  static constexpr int kSize = 2 * kHalf + 1;
  static constexpr int kVectors = (kSize + 7) / 8;

  /// Takes the template around `px` from `image`. Returns false when it leaves the image or when
  /// its gradients do not determine a translation.
  [[nodiscard]] bool cut(const ImageView& image, const Eigen::Vector2f& px);

  /// Takes a warped template. `A` maps an offset from the centre in the image to search in to an
  /// offset in `image`.
  [[nodiscard]] bool cut(const ImageView& image, const Eigen::Vector2f& px,
                         const Eigen::Matrix2f& A);

  /// Aligns the template to `image`, starting at `start`. It fails when the template leaves the
  /// image or a limit is exceeded.
  [[nodiscard]] Alignment align(const ImageView& image, const Eigen::Vector2f& start,
                                const AlignLimits& limits) const;

 private:
  static constexpr int kPixels = kSize * kSize;
  static constexpr int kRawSize = kSize + 2;        // a border of one pixel for the gradients
  static constexpr int kRawVectors = kVectors + 1;  // shifted loads stay inside a row
  using Raw = float[kRawSize][8 * kRawVectors];

  // Sums over the pixels of the image patch P, of its square, and of its products with the template
  // and the gradients.
  struct Sums {
    float p, pp, pt, px, py;
  };

  static Float8 mask(int vector);
  // Computes gradients, means and sums. Returns whether they determine a translation.
  bool prepare(const Raw& raw);
  Sums compare(const std::uint8_t* corner, std::ptrdiff_t stride, float fu, float fv) const;

  alignas(32) Float8 value_[kSize][kVectors];
  alignas(32) Float8 gx_[kSize][kVectors];
  alignas(32) Float8 gy_[kSize][kVectors];
  float mean_ = 0.0F;                                  // of the template's grey values
  float tt_ = 0.0F;                                    // sum T T
  float gxt_ = 0.0F, gyt_ = 0.0F;                      // sum G T
  float a_ = 0.0F, b_ = 0.0F, c_ = 0.0F, det_ = 0.0F;  // sum G G^T = (a b; b c), its determinant
};

extern template class Patch<5>;
extern template class Patch<7>;

}  // namespace plumb::vo
