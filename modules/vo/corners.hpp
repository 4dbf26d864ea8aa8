/// Detection of corners (Shi & Tomasi, "Good Features to Track", 1994), one per cell of a grid.
///
/// Frames:
///   img, of the image that is passed to detect().
/// Units:
///   Pixels. The corner measure is the smaller eigenvalue of the mean structure tensor,
///   grey^2/px^2.
/// Memory:
///   Buffers for one cell and masks for the image, allocated by the constructor.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/image_view.hpp"

namespace plumb::vo {

struct CornerOptions {
  double min_corner_grey2 = 2.5;  ///< threshold of the corner measure
  double horizon_px = 0.0;        ///< row below which the threshold is lower, as on a road
};

class CornerDetector {
 public:
  /// Divides the image into about `max_corners` cells.
  CornerDetector(int width_px, int height_px, int max_corners);

  /// Makes all cells free.
  void clear();
  /// Marks the cell and the surroundings of `px` as occupied.
  void occupy(const Eigen::Vector2d& px);
  /// Excludes a square of `size_px` pixels from the search.
  void exclude(const Eigen::Vector2i& first_px, int size_px);
  /// Returns the best corner of every free cell, outside the surroundings of others. The cells are
  /// occupied then. The result is valid until the next call.
  const std::vector<Eigen::Vector2d>& detect(const ImageView& image, const CornerOptions& options);

 private:
  struct Cell {
    int u0, v0, u1, v1;  // pixels [u0, u1) x [v0, v1)
  };
  [[nodiscard]] Cell cell(int column, int row) const;
  void tensor_rows(const ImageView& image, const Cell& c);
  [[nodiscard]] bool best_in(const Cell& c, float threshold, Eigen::Vector2d* px) const;

  int width_px_;
  int height_px_;
  int columns_;
  int rows_;
  int pitch_;  // length of a row in the buffers
  std::vector<unsigned char> cell_occupied_;
  int mask_width_;
  std::vector<unsigned char> mask_;              // occupied surroundings, in blocks of pixels
  std::vector<float> xx_, xy_, yy_;              // products of the gradients
  std::vector<float> sum_xx_, sum_xy_, sum_yy_;  // sums of the products over the rows of a box
  std::vector<Eigen::Vector2d> found_;
};

}  // namespace plumb::vo
