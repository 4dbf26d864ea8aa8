/// Shi-Tomasi corners, one per empty cell of a grid.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/image_view.hpp"

namespace plumb::vo {

struct CornerOptions {
  double min_corner_grey2 = 2.5;  ///< smaller eigenvalue of the mean structure tensor
  double horizon_px = 0.0;        ///< below it the threshold is lower: roads have little contrast
};

class CornerDetector {
 public:
  /// Cells are sized so that about `max_corners` fit the image.
  CornerDetector(int width_px, int height_px, int max_corners);

  /// Forgets what is taken.
  void clear();
  /// Keeps new corners out of the cell and the surroundings of `px`.
  void take(const Eigen::Vector2d& px);
  /// The best corner of each cell that nothing has taken. Valid until the next call.
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
  int pitch_;  // of the tensor buffers
  std::vector<unsigned char> cell_taken_;
  int mask_width_;
  std::vector<unsigned char> mask_;  // in blocks of pixels
  std::vector<float> xx_, xy_, yy_;  // products of gradients, then their box means
  std::vector<float> sum_xx_, sum_xy_, sum_yy_;
  std::vector<Eigen::Vector2d> found_;
};

}  // namespace plumb::vo
