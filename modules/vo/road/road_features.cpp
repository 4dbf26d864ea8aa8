#include "modules/vo/road/road_features.hpp"

#include <cmath>

#include "core/numbers.hpp"

namespace plumb::vo {
namespace {

// Half sizes of the means, in cells: rows and columns of the one for the second difference, rows of
// the one for the contrast along the road.
constexpr std::size_t kHalfRows = 3;
constexpr std::size_t kHalfColumns = 2;
constexpr std::size_t kHalfLongRows = 7;
// Distance of the outer means of the second difference.
constexpr std::size_t kApart = 14;

// Noise of the smoothed grey values that no feature is told from.
constexpr float kNoise_grey = 1.0F;
constexpr float kSaturation_grey = 4.0F * kNoise_grey;
constexpr float kAlongWeight = 0.25F;

constexpr std::size_t cell(std::size_t row, std::size_t column) {
  return row * kNumRoadColumns + column;
}

/// Grey value between pixels, or NaN outside of the image.
float interpolate(const ImageView& image, const Eigen::Vector2d& px) {
  const double u = px.x();
  const double v = px.y();
  if (!(u >= 0.0 && v >= 0.0 && u < image.width_px - 1 && v < image.height_px - 1))
    return static_cast<float>(kNan);
  const auto u0 = static_cast<int>(u);
  const auto v0 = static_cast<int>(v);
  const auto a = static_cast<float>(u - u0);
  const auto b = static_cast<float>(v - v0);
  const std::uint8_t* top = image.row(v0) + u0;
  const std::uint8_t* bottom = image.row(v0 + 1) + u0;
  const float upper = static_cast<float>(top[0]) + a * static_cast<float>(top[1] - top[0]);
  const float lower = static_cast<float>(bottom[0]) + a * static_cast<float>(bottom[1] - bottom[0]);
  return upper + b * (lower - upper);
}

/// Mean over 2 kHalf + 1 rows; NaN where one of them is.
template <std::size_t kHalf>
void mean_of_rows(const RoadGrid& in, RoadGrid* out) {
  out->fill(static_cast<float>(kNan));
  for (std::size_t row = kHalf; row + kHalf < kNumRoadRows; ++row) {
    std::array<float, kNumRoadColumns> sum{};
    for (std::size_t i = row - kHalf; i <= row + kHalf; ++i) {
      for (std::size_t column = 0; column < kNumRoadColumns; ++column)
        sum[column] += in[cell(i, column)];
    }
    constexpr float kShare = 1.0F / static_cast<float>(2 * kHalf + 1);
    for (std::size_t column = 0; column < kNumRoadColumns; ++column)
      (*out)[cell(row, column)] = sum[column] * kShare;
  }
}

/// Mean over 2 kHalfColumns + 1 columns, in place.
void mean_of_columns(RoadGrid* grid) {
  constexpr float kShare = 1.0F / static_cast<float>(2 * kHalfColumns + 1);
  for (std::size_t row = 0; row < kNumRoadRows; ++row) {
    std::array<float, kNumRoadColumns> mean;
    mean.fill(static_cast<float>(kNan));
    for (std::size_t column = kHalfColumns; column + kHalfColumns < kNumRoadColumns; ++column) {
      float sum = 0.0F;
      for (std::size_t i = column - kHalfColumns; i <= column + kHalfColumns; ++i)
        sum += (*grid)[cell(row, i)];
      mean[column] = sum * kShare;
    }
    for (std::size_t column = 0; column < kNumRoadColumns; ++column)
      (*grid)[cell(row, column)] = mean[column];
  }
}

}  // namespace

void RoadFeatures::find(const ImageView& image, const Eigen::Vector2d& direction,
                        RoadGrid* features) {
  sample(image, direction);
  smooth();
  difference(features);
}

void RoadFeatures::sample(const ImageView& image, const Eigen::Vector2d& direction) {
  const Eigen::Vector3d forward = direction.homogeneous().normalized();
  const Eigen::Vector3d right = Eigen::Vector3d(forward.z(), 0.0, -forward.x()).normalized();
  const Eigen::Vector3d down = forward.cross(right);
  constexpr double kMiddle = 0.5 * static_cast<double>(kNumRoadColumns - 1);
  for (std::size_t row = 0; row < kNumRoadRows; ++row) {
    const Eigen::Vector3d middle = down + row_distance(static_cast<double>(row)) * forward;
    for (std::size_t column = 0; column < kNumRoadColumns; ++column) {
      const double aside = (static_cast<double>(column) - kMiddle) * kRoadColumnStep;
      grey_[cell(row, column)] = interpolate(image, camera_.project(middle + aside * right));
    }
  }
}

void RoadFeatures::smooth() {
  mean_of_rows<kHalfRows>(grey_, &smoothed_);
  mean_of_columns(&smoothed_);
  mean_of_rows<kHalfLongRows>(grey_, &along_);
}

void RoadFeatures::difference(RoadGrid* features) const {
  features->fill(0.0F);
  for (std::size_t row = kApart; row + kApart < kNumRoadRows; ++row) {
    for (std::size_t column = kHalfColumns; column + kHalfColumns < kNumRoadColumns; ++column) {
      const float across =
          smoothed_[cell(row, column)] -
          0.5F * (smoothed_[cell(row - kApart, column)] + smoothed_[cell(row + kApart, column)]);
      const float along = 0.5F * (along_[cell(row, column + 1)] + along_[cell(row, column + 2)] -
                                  along_[cell(row, column - 1)] - along_[cell(row, column - 2)]);
      if (!std::isfinite(across) || !std::isfinite(along)) continue;
      const float power = across * across;
      const float clear =
          power / (power + kAlongWeight * along * along + kNoise_grey * kNoise_grey);
      (*features)[cell(row, column)] =
          clear * across / std::sqrt(power + kSaturation_grey * kSaturation_grey);
    }
  }
}

}  // namespace plumb::vo
