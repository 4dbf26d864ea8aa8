#include "modules/vo/corners.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::vo {
namespace {

/// Converts an index into a buffer. An image has at most 2^26 pixels, so that int is large enough.
constexpr std::size_t to_index(int i) { return static_cast<std::size_t>(i); }

constexpr int kCornerBorderPx = 6;
constexpr int kBoxHalf = 2;    // the structure tensor is a mean over 5 x 5 pixels
constexpr int kMaskStep = 2;   // size of a block [px]
constexpr int kMaskReach = 2;  // number of blocks around a point that are occupied
constexpr double kRoadThresholdRatio = 0.15;

// Computes the products of the Sobel gradients [grey/px] along one row.
void products(const ImageView& image, int u0, int v, int n, float* __restrict xx,
              float* __restrict xy, float* __restrict yy) {
  const std::uint8_t* __restrict a = image.row(v - 1) + u0;
  const std::uint8_t* __restrict b = image.row(v) + u0;
  const std::uint8_t* __restrict c = image.row(v + 1) + u0;
  for (int i = 0; i < n; ++i) {
    const int gx = (a[i + 1] - a[i - 1]) + 2 * (b[i + 1] - b[i - 1]) + (c[i + 1] - c[i - 1]);
    const int gy = (c[i - 1] - a[i - 1]) + 2 * (c[i] - a[i]) + (c[i + 1] - a[i + 1]);
    const float x = static_cast<float>(gx) * 0.125F;
    const float y = static_cast<float>(gy) * 0.125F;
    xx[i] = x * x;
    xy[i] = x * y;
    yy[i] = y * y;
  }
}

// Sums 2 kBoxHalf + 1 rows. best_in() sums along the rows.
void box_row(const float* __restrict in, int pitch, int n, float* __restrict out) {
  for (int i = 0; i < n; ++i) {
    out[i] = in[i] + in[i + pitch] + in[i + 2 * pitch] + in[i + 3 * pitch] + in[i + 4 * pitch];
  }
}

}  // namespace

CornerDetector::CornerDetector(int width_px, int height_px, int max_corners)
    : width_px_(width_px), height_px_(height_px) {
  const double side = std::sqrt(1.0 * width_px * height_px / max_corners);
  columns_ = std::max(1, static_cast<int>(width_px / side));
  rows_ = std::max(1, static_cast<int>(height_px / side));
  pitch_ = width_px / columns_ + 2 * kBoxHalf + 16;
  const auto buffer = to_index(pitch_ * (height_px / rows_ + 2 * kBoxHalf + 8));
  cell_occupied_.resize(to_index(columns_ * rows_));
  mask_width_ = width_px / kMaskStep + 1;
  mask_.resize(to_index(mask_width_ * (height_px / kMaskStep + 1)));
  for (auto* v : {&xx_, &xy_, &yy_, &sum_xx_, &sum_xy_, &sum_yy_}) v->resize(buffer);
  found_.reserve(cell_occupied_.size());
}

CornerDetector::Cell CornerDetector::cell(int column, int row) const {
  return {std::max(kCornerBorderPx, column * width_px_ / columns_),
          std::max(kCornerBorderPx, row * height_px_ / rows_),
          std::min(width_px_ - kCornerBorderPx - 1, (column + 1) * width_px_ / columns_),
          std::min(height_px_ - kCornerBorderPx - 1, (row + 1) * height_px_ / rows_)};
}

void CornerDetector::clear() {
  std::fill(cell_occupied_.begin(), cell_occupied_.end(), static_cast<unsigned char>(0));
  std::fill(mask_.begin(), mask_.end(), static_cast<unsigned char>(0));
}

void CornerDetector::occupy(const Eigen::Vector2d& px) {
  const int u = std::clamp(static_cast<int>(px.x()), 0, width_px_ - 1);
  const int v = std::clamp(static_cast<int>(px.y()), 0, height_px_ - 1);
  const int column = std::min(columns_ - 1, u * columns_ / width_px_);
  const int row = std::min(rows_ - 1, v * rows_ / height_px_);
  cell_occupied_[to_index(row * columns_ + column)] = 1;
  const int last_v = height_px_ / kMaskStep;
  for (int j = v / kMaskStep - kMaskReach; j <= v / kMaskStep + kMaskReach; ++j) {
    for (int i = u / kMaskStep - kMaskReach; i <= u / kMaskStep + kMaskReach; ++i) {
      if (i < 0 || j < 0 || i >= mask_width_ || j > last_v) continue;
      mask_[to_index(j * mask_width_ + i)] = 1;
    }
  }
}

void CornerDetector::exclude(const Eigen::Vector2i& first_px, int size_px) {
  const int last_i = std::min(mask_width_ - 1, (first_px.x() + size_px - 1) / kMaskStep);
  const int last_j = std::min(height_px_ / kMaskStep, (first_px.y() + size_px - 1) / kMaskStep);
  for (int j = first_px.y() / kMaskStep; j <= last_j; ++j) {
    for (int i = first_px.x() / kMaskStep; i <= last_i; ++i)
      mask_[to_index(j * mask_width_ + i)] = 1;
  }
}

// Computes the products of the gradients in a cell and their sums over the rows of the boxes.
void CornerDetector::tensor_rows(const ImageView& image, const Cell& c) {
  const int n = c.u1 - c.u0 + 2 * kBoxHalf;
  const int m = c.v1 - c.v0 + 2 * kBoxHalf;
  for (int j = 0; j < m; ++j) {
    const auto at = to_index(j * pitch_);
    products(image, c.u0 - kBoxHalf, c.v0 - kBoxHalf + j, n, &xx_[at], &xy_[at], &yy_[at]);
  }
  for (int j = 0; j + 2 * kBoxHalf < m; ++j) {
    const auto at = to_index(j * pitch_);
    box_row(&xx_[at], pitch_, n, &sum_xx_[at]);
    box_row(&xy_[at], pitch_, n, &sum_xy_[at]);
    box_row(&yy_[at], pitch_, n, &sum_yy_[at]);
  }
}

// Finds the pixel with the largest corner measure in a cell. Returns false when none exceeds the
// threshold.
bool CornerDetector::best_in(const Cell& c, float threshold, Eigen::Vector2d* px) const {
  constexpr float kMean = 1.0F / 25.0F;
  float best = threshold;
  bool any = false;
  const auto along = [](const float* s, int i) {
    return (s[i] + s[i + 1] + s[i + 2] + s[i + 3] + s[i + 4]) * kMean;
  };
  float score[512];
  const int n = std::min(c.u1 - c.u0, 512);
  for (int v = c.v0; v < c.v1; ++v) {
    const auto at = to_index((v - c.v0) * pitch_);
    const float* sxx = &sum_xx_[at];
    const float* sxy = &sum_xy_[at];
    const float* syy = &sum_yy_[at];
    for (int i = 0; i < n; ++i) {
      const float xx = along(sxx, i);
      const float xy = along(sxy, i);
      const float yy = along(syy, i);
      score[i] = 0.5F * (xx + yy - std::sqrt((xx - yy) * (xx - yy) + 4.0F * xy * xy));
    }
    const auto mask_row = to_index(v / kMaskStep * mask_width_);
    for (int i = 0; i < n; ++i) {
      if (score[i] <= best) continue;
      if (mask_[mask_row + static_cast<std::size_t>((c.u0 + i) / kMaskStep)] != 0) continue;
      best = score[i];
      *px = {c.u0 + i, v};
      any = true;
    }
  }
  return any;
}

const std::vector<Eigen::Vector2d>& CornerDetector::detect(const ImageView& image,
                                                           const CornerOptions& options) {
  found_.clear();
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      if (cell_occupied_[to_index(row * columns_ + column)] != 0) continue;
      const Cell c = cell(column, row);
      if (c.u1 <= c.u0 || c.v1 <= c.v0) continue;
      tensor_rows(image, c);
      const bool road = c.v0 > options.horizon_px;
      const double threshold = options.min_corner_grey2 * (road ? kRoadThresholdRatio : 1.0);
      Eigen::Vector2d px;
      if (!best_in(c, static_cast<float>(threshold), &px)) continue;
      found_.push_back(px);
      occupy(px);
    }
  }
  return found_;
}

}  // namespace plumb::vo
