/// Fits a Gaussian dip to a slice through a cost: f(x) = offset - depth exp(-(x - centre)^2 / (2
/// width^2)).
///
/// Its width is the confidence of Song and Chandraker's models A (CVPR 2014, section 5.1.1): how
/// sharply the cost determines x.
#pragma once

#include <array>
#include <cstddef>

namespace plumb {

inline constexpr std::size_t kSliceSamples = 50;

struct Slice {
  std::array<double, kSliceSamples> x{};  ///< evenly spaced, ascending
  std::array<double, kSliceSamples> f{};
};

struct GaussianDip {
  /// There is a dip near the middle of the slice, wide enough to show between the samples.
  bool ok = false;
  double centre = 0.0;
  double width = 0.0;  ///< sigma, unit of x
  double depth = 0.0;
  double offset = 0.0;
};

[[nodiscard]] GaussianDip fit_gaussian(const Slice& slice);

}  // namespace plumb
