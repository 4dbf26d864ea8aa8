/// Image pyramid by 2x2 averages, in owned storage.
///
/// Level l is half the size of level l-1 (rounded down). Because each pixel averages a 2x2 block,
/// pixel centres move: u_l = (u_0 + 0.5) / 2^l - 0.5.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image_view.hpp"

namespace plumb {

class Pyramid {
 public:
  static constexpr int kMaxLevels = 5;

  /// Allocates every level. @pre width_px, height_px >= 2^num_levels, 1 <= num_levels <= kMaxLevels
  Pyramid(int width_px, int height_px, int num_levels);

  // The views point into the storage: it may move, a copy would look into the original.
  Pyramid(const Pyramid&) = delete;
  Pyramid& operator=(const Pyramid&) = delete;
  Pyramid(Pyramid&&) = default;
  Pyramid& operator=(Pyramid&&) = default;

  /// Copies `image` to level 0 and fills the rest. @pre image has the constructed size
  void build(const ImageView& image);

  [[nodiscard]] int num_levels() const { return num_levels_; }
  [[nodiscard]] const ImageView& level(int l) const { return views_[static_cast<std::size_t>(l)]; }

  /// Coordinate at level l of a level-0 coordinate, and back.
  [[nodiscard]] static double to_level(double u0, int l) { return (u0 + 0.5) / (1 << l) - 0.5; }
  [[nodiscard]] static double from_level(double ul, int l) { return (ul + 0.5) * (1 << l) - 0.5; }

 private:
  int num_levels_;
  std::vector<std::uint8_t> storage_;
  std::array<ImageView, kMaxLevels> views_{};
};

}  // namespace plumb
