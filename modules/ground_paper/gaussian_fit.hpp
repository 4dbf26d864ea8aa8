/// A Gaussian dip fitted to a slice through a cost: f(x) = offset - depth exp(-(x - centre)^2 / (2
/// width^2)).
///
/// Its width is the belief of Song and Chandraker's model A: how sharply the cost tells x.
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
  bool ok = false;  ///< a dip near the slice's middle, wider than the samples' spacing can hide
  double centre = 0.0;
  double width = 0.0;  ///< sigma, unit of x
  double depth = 0.0;
  double offset = 0.0;
};

[[nodiscard]] GaussianDip fit_gaussian(const Slice& slice);

}  // namespace plumb
