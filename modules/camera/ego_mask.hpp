/// What the camera never sees of the road: bonnet, wiper rest, housing, and the corners
/// rectification leaves.
///
/// A masked pixel gets one flat grey per frame, so that nothing can be tracked there. That grey is
/// the mean of the band around the mask, and the image blends into it over `feather_px`: a hard
/// step would be a corner that stands still in every frame, which is what the mask is there to
/// prevent.
///
/// Frames   img of the published image, (0,0) is the centre of the upper left pixel.
/// Memory   allocated at construction: one weight per pixel that is not left alone.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace plumb {

/// Covered pixels of one image, for building. Everything here may allocate.
class MaskPainter {
 public:
  MaskPainter(int width_px, int height_px);

  void add_rows(int num_top, int num_bottom);
  /// Non-zero covers. @pre width_px * height_px bytes, rows without gaps
  void add_bytes(const std::uint8_t* bytes);
  /// "u,v u,v u,v ...", at least three corners; a pixel is covered when its centre is inside
  /// (even-odd rule). False when the text is not that.
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

  /// In place. @pre `image` has the painter's size, rows without gaps
  void apply(std::uint8_t* image) const;

  /// True when no pixel is touched.
  [[nodiscard]] bool empty() const { return runs_.empty(); }

 private:
  struct Run {
    std::uint32_t begin;  ///< first pixel, counted over the whole image
    std::uint32_t length;
    std::uint32_t weight;  ///< index of its first weight
  };
  [[nodiscard]] std::uint32_t band_mean(const std::uint8_t* image) const;

  std::vector<Run> runs_;
  std::vector<std::uint16_t> weights_;  ///< [1/256] share of the image's own pixel
};

}  // namespace plumb
