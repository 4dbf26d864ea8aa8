/// An image pyramid whose pixels are averages of 2x2 pixels of the level below.
///
/// Level l is half the size of level l-1, rounded down.
///
/// Frames:
///   img: (0,0) is the centre of the upper left pixel, on every level. A pixel of level l is the
///   average of a block of 2^l x 2^l pixels, so that u_l = (u_0 + 0.5) / 2^l - 0.5.
/// Memory:
///   One buffer for all levels, allocated by the constructor.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image_view.hpp"

namespace plumb {

class Pyramid {
 public:
  static constexpr int kMaxLevels = 5;

  /// Allocates all levels.
  /// @pre width_px, height_px >= 2^num_levels, 1 <= num_levels <= kMaxLevels
  Pyramid(int width_px, int height_px, int num_levels);

  // The views point into the storage, which moves along. A copy's views would point into the
  // original.
  Pyramid(const Pyramid&) = delete;
  Pyramid& operator=(const Pyramid&) = delete;
  Pyramid(Pyramid&&) = default;
  Pyramid& operator=(Pyramid&&) = default;

  /// Copies `image` to level 0 and computes the other levels.
  /// @pre image has the size that the constructor was given
  void build(const ImageView& image);

  [[nodiscard]] int num_levels() const { return num_levels_; }
  [[nodiscard]] const ImageView& level(int l) const { return views_[static_cast<std::size_t>(l)]; }

  /// Converts a coordinate from level 0 to level l, and back.
  [[nodiscard]] static double to_level(double u0, int l) { return (u0 + 0.5) / (1 << l) - 0.5; }
  [[nodiscard]] static double from_level(double ul, int l) { return (ul + 0.5) * (1 << l) - 0.5; }

 private:
  int num_levels_;
  std::vector<std::uint8_t> storage_;
  std::array<ImageView, kMaxLevels> views_{};
};

}  // namespace plumb
