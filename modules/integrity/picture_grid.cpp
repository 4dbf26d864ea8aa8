#include "modules/integrity/picture_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace plumb {
namespace {

/// Columns of a block are a multiple of this, for the width of vector registers.
constexpr int kColumnStepPx = 32;
constexpr int kMaxRowsPerBlock = 8;

/// Sum of absolute differences. The compiler turns this form into its SAD instruction.
int absolute_differences(const std::uint8_t* a, const std::uint8_t* b, int count) {
  int sum = 0;
  for (int i = 0; i < count; ++i) sum += std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i]));
  return sum;
}

int sum_of(const std::uint8_t* p, int count) {
  int sum = 0;
  for (int i = 0; i < count; ++i) sum += p[i];
  return sum;
}

}  // namespace

PictureGrid::PictureGrid(int width, int height)
    : width_px(width),
      height_px(height),
      block_width_px(kColumnStepPx * ((width + kColumnStepPx * kMaxGridColumns - 1) /
                                      (kColumnStepPx * kMaxGridColumns))),
      num_columns(width / block_width_px),
      rows_per_block(std::clamp(height / kGridRows, 1, kMaxRowsPerBlock)),
      first_column_px((width - num_columns * block_width_px) / 2) {}

PictureSample::PictureSample(const PictureGrid& grid)
    : grid_(grid), rows_(static_cast<std::size_t>(grid.num_rows() * grid.row_width_px())) {}

void PictureSample::take(const ImageView& image) {
  const auto width = static_cast<std::size_t>(grid_.row_width_px());
  for (int i = 0; i < grid_.num_rows(); ++i) {
    std::memcpy(rows_.data() + static_cast<std::size_t>(i) * width,
                image.row(grid_.image_row(i)) + grid_.first_column_px, width);
  }
  for (int row = 0; row < kGridRows; ++row)
    for (int column = 0; column < grid_.num_columns; ++column) measure_block(row, column);
}

void PictureSample::measure_block(int block_row, int column) {
  const int width = grid_.block_width_px;
  std::array<int, kNumShifts> differences{};
  int sum = 0;
  for (int i = 0; i < grid_.rows_per_block; ++i) {
    const std::uint8_t* p = row(block_row * grid_.rows_per_block + i) + column * width;
    sum += sum_of(p, width);
    for (int s = 0; s < kNumShifts; ++s) {
      const int shift = 1 << s;
      differences[static_cast<std::size_t>(s)] += absolute_differences(p, p + shift, width - shift);
    }
  }
  const auto block = static_cast<std::size_t>(block_row * grid_.num_columns + column);
  const auto rows = static_cast<float>(grid_.rows_per_block);
  mean_[block] = static_cast<float>(sum) / (rows * static_cast<float>(width));
  for (std::size_t s = 0; s < kNumShifts; ++s) {
    const auto columns = static_cast<float>(width - (1 << s));
    structure_[s][block] = static_cast<float>(differences[s]) / (rows * columns);
  }
}

void compare_blocks(const PictureGrid& grid, const PictureSample& a, const PictureSample& b,
                    BlockValues* difference) {
  const int width = grid.block_width_px;
  const auto samples = static_cast<float>(width * grid.rows_per_block);
  for (int block_row = 0; block_row < kGridRows; ++block_row) {
    std::array<int, kMaxGridColumns> sums{};
    for (int i = 0; i < grid.rows_per_block; ++i) {
      const std::uint8_t* p = a.row(block_row * grid.rows_per_block + i);
      const std::uint8_t* q = b.row(block_row * grid.rows_per_block + i);
      for (int column = 0; column < grid.num_columns; ++column) {
        sums[static_cast<std::size_t>(column)] +=
            absolute_differences(p + column * width, q + column * width, width);
      }
    }
    for (int column = 0; column < grid.num_columns; ++column) {
      (*difference)[static_cast<std::size_t>(block_row * grid.num_columns + column)] =
          static_cast<float>(sums[static_cast<std::size_t>(column)]) / samples;
    }
  }
}

double apparent_shift_px(const PictureSample& sample, int block, double difference) {
  const auto b = static_cast<std::size_t>(block);
  const auto at = [&](int s) { return static_cast<double>(sample.structure(s)[b]); };
  if (difference <= at(0)) return at(0) > 0.0 ? difference / at(0) : 0.0;
  for (int s = 0; s + 1 < kNumShifts; ++s) {
    if (at(s + 1) <= difference) continue;
    const double part = (difference - at(s)) / std::max(1e-3, at(s + 1) - at(s));
    return std::ldexp(1.0 + std::clamp(part, 0.0, 1.0), s);
  }
  return kMaxShiftPx;
}

}  // namespace plumb
