/// A mask over the pixels that never show the road: the bonnet, the wipers at rest, the housing of
/// the camera and the corners that rectification leaves empty.
///
/// All masked pixels of a frame get the same grey level, so that no feature can be tracked there.
/// The level is the mean of the band around the mask, and the image blends into it over
/// `feather_px`. A sharp step would itself be a static feature, which the mask has to prevent.
///
/// Frames:
///   img of the published image; (0,0) is the centre of the upper left pixel.
/// Memory:
///   One weight per changed pixel, allocated at construction.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace plumb {

/// Collects the covered pixels of one image. Every function may allocate.
class MaskPainter {
 public:
  MaskPainter(int width_px, int height_px);

  void add_rows(int num_top, int num_bottom);
  /// Covers the pixels whose byte is not zero.
  /// @pre width_px * height_px bytes, rows without gaps
  void add_bytes(const std::uint8_t* bytes);
  /// Covers the pixels whose centres are inside a polygon (even-odd rule). `text` lists at least
  /// three corners as "u,v u,v u,v ...". Returns false for any other text.
  [[nodiscard]] bool add_polygon(std::string_view text);

  [[nodiscard]] int width_px() const { return width_px_; }
  [[nodiscard]] int height_px() const { return height_px_; }
  [[nodiscard]] const std::vector<std::uint8_t>& covered() const { return covered_; }
  [[nodiscard]] double covered_ratio() const;

 private:
  int width_px_;
  int height_px_;
  std::vector<std::uint8_t> covered_;
};

class EgoMask {
 public:
  /// @pre feather_px >= 1
  EgoMask(const MaskPainter& painter, int feather_px);

  /// Masks `image` in place.
  /// @pre `image` has the painter's size and rows without gaps
  void apply(std::uint8_t* image) const;

  /// True when the mask changes no pixel.
  [[nodiscard]] bool empty() const { return runs_.empty(); }

 private:
  struct Run {
    std::uint32_t begin;  ///< index of the first pixel in the whole image
    std::uint32_t length;
    std::uint32_t weight;  ///< index of the first weight
  };
  [[nodiscard]] std::uint32_t band_mean(const std::uint8_t* image) const;

  std::vector<Run> runs_;
  std::vector<std::uint16_t> weights_;  ///< [1/256] share of the image in the blend
};

}  // namespace plumb
