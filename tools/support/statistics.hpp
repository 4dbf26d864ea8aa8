/// Order statistics and means of lists of numbers. Empty input gives NaN.
#pragma once

#include <vector>

namespace plumb {

/// Interpolates linearly between order statistics; q in [0, 1].
[[nodiscard]] double quantile(std::vector<double> values, double q);
[[nodiscard]] double median(std::vector<double> values);
/// 1.4826 times the median absolute deviation, which estimates the standard deviation of normally
/// distributed values whatever a few outliers are.
[[nodiscard]] double robust_std(const std::vector<double>& values);
[[nodiscard]] double mean(const std::vector<double>& values);
/// Standard deviation about the mean with n - 1 in the denominator; 0 for one value.
[[nodiscard]] double standard_deviation(const std::vector<double>& values);
[[nodiscard]] double rms(const std::vector<double>& values);

}  // namespace plumb
