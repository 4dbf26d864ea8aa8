/// Order statistics of a few values, without sorting all of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace plumb {

/// The value below which about `share` of `values` lie. It reorders `values`.
/// @pre values is not empty, 0 <= share <= 1
[[nodiscard]] inline double percentile(std::vector<double>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The median; the upper one of the two middle values when their number is even. It reorders `values`.
/// @pre values is not empty
[[nodiscard]] inline double upper_median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace plumb
