/// Order statistics by partial sorting (std::nth_element), in linear time on average.
///
/// Memory:
///   Nothing is allocated. The values are reordered in place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace plumb {

/// Returns the `fraction` quantile, e.g. 0.8 for the 80th percentile. It is the element at the
/// sorted position fraction (n - 1), rounded down; nothing is interpolated.
/// @pre values is not empty, 0 <= fraction <= 1
[[nodiscard]] inline double percentile(std::span<double> values, double fraction) {
  const auto position =
      static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  const auto nth = values.begin() + position;
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// Returns the median. Of an even number of values it is the upper one of the two in the middle.
/// @pre values is not empty
[[nodiscard]] inline double upper_median(std::span<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace plumb
