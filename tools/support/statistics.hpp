/// Order statistics and means of a handful of numbers. Empty input gives NaN.
#pragma once

#include <vector>

namespace plumb {

/// Linear between order statistics; q in [0, 1].
[[nodiscard]] double quantile(std::vector<double> values, double q);
[[nodiscard]] double median(std::vector<double> values);
/// 1.4826 times the median absolute deviation: the standard deviation of a normal law, deaf to
/// outliers.
[[nodiscard]] double robust_std(const std::vector<double>& values);
[[nodiscard]] double mean(const std::vector<double>& values);
/// About the mean, n - 1 in the denominator; 0 for one value.
[[nodiscard]] double standard_deviation(const std::vector<double>& values);
[[nodiscard]] double rms(const std::vector<double>& values);

}  // namespace plumb
