/// What the picture memory keeps of an image: sampled rows, and statistics of a grid of blocks.
///
/// A block is `block_width_px` columns wide and spans `rows_per_block` sampled rows. The grid has
/// kGridRows rows of blocks and up to kMaxGridColumns columns; it is centred, so that a mirrored
/// image has the mirrored grid.
///
/// Units:
///   Grey levels [grey]; pixels of the full image [px].
/// Memory:
///   The sampled rows of one image per PictureSample, allocated at construction.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <vector>

#include "core/image_view.hpp"

namespace plumb {

inline constexpr int kGridRows = 12;
inline constexpr int kMaxGridColumns = 16;
inline constexpr int kMaxBlocks = kGridRows * kMaxGridColumns;
/// The structure function is known at shifts of 1, 2, 4, 8 and 16 px.
inline constexpr int kNumShifts = 5;
/// Displacements are not told apart beyond this [px].
inline constexpr double kMaxShiftPx = 32.0;

/// One bit per block, row by row from the top.
using BlockMask = std::bitset<kMaxBlocks>;
/// One number per block; those past PictureGrid::num_blocks() are 0.
using BlockValues = std::array<float, kMaxBlocks>;

/// Where rows are sampled and blocks lie, for images of one size.
struct PictureGrid {
  static constexpr int kMinWidthPx = 64;
  static constexpr int kMinHeightPx = 2 * kGridRows;

  /// @pre width_px >= kMinWidthPx, height_px >= kMinHeightPx
  PictureGrid(int width_px, int height_px);

  [[nodiscard]] int num_blocks() const { return kGridRows * num_columns; }
  [[nodiscard]] int num_rows() const { return kGridRows * rows_per_block; }
  [[nodiscard]] int row_width_px() const { return num_columns * block_width_px; }
  /// Row of the image that sampled row `i` is taken from.
  [[nodiscard]] int image_row(int i) const { return (2 * i + 1) * height_px / (2 * num_rows()); }

  int width_px;
  int height_px;
  int block_width_px;
  int num_columns;
  int rows_per_block;
  int first_column_px;
};

/// One image's sampled rows and its blocks' statistics.
class PictureSample {
 public:
  explicit PictureSample(const PictureGrid& grid);

  /// @pre `image` has the grid's size
  void take(const ImageView& image);

  /// Row `i` of the sampled ones, restricted to the grid.
  [[nodiscard]] const std::uint8_t* row(int i) const {
    return rows_.data() + static_cast<std::ptrdiff_t>(i) * grid_.row_width_px();
  }
  [[nodiscard]] const BlockValues& mean() const { return mean_; }
  /// Mean absolute difference of pixels that lie 2^shift px apart in a row: the structure function.
  [[nodiscard]] const BlockValues& structure(int shift) const {
    return structure_[static_cast<std::size_t>(shift)];
  }

 private:
  void measure_block(int row, int column);

  PictureGrid grid_;
  std::vector<std::uint8_t> rows_;
  BlockValues mean_{};
  std::array<BlockValues, kNumShifts> structure_{};
};

/// Mean absolute difference of two images per block [grey]; exactly 0 where all samples are equal.
void compare_blocks(const PictureGrid& grid, const PictureSample& a, const PictureSample& b,
                    BlockValues* difference);

/// Displacement that explains a block's difference [px]: the shift at which the structure function
/// reaches `difference`. Noise alone gives a fraction of a pixel; kMaxShiftPx when it is never
/// reached. An estimate of magnitude only, good to about a factor of two.
[[nodiscard]] double apparent_shift_px(const PictureSample& sample, int block, double difference);

}  // namespace plumb
