/// Algorithm 1 of Song and Chandraker (CVPR 2014): a line that predicts the variance of a cue's
/// error from its confidence.
///
/// The confidences are put into bins of equal count. Each bin has the second moment of its errors.
/// The paper takes the variance of |error|, which is 0.36 of that for a normal distribution and
/// would make fused standard deviations too small. The line is fitted to the bins.
#pragma once

#include <vector>

#include "modules/ground/types/linear_variance.hpp"

namespace plumb {

inline constexpr int kNumConfidenceBins = 100;

struct Confidence {
  double confidence = 0.0;
  double error = 0.0;
};

struct ConfidenceBin {
  double centre = 0.0;    ///< mean confidence
  double variance = 0.0;  ///< mean e^2
  int num = 0;
};

/// Makes at most `num_bins` bins of equal count with at least two confidences each, which need not
/// be sorted.
[[nodiscard]] std::vector<ConfidenceBin> bin_confidences(std::vector<Confidence> confidences,
                                                         int num_bins);

/// Fits the line by least squares and takes bounds and mean from the bins. @pre bins not empty
[[nodiscard]] LinearVariance fit_line(const std::vector<ConfidenceBin>& bins);

}  // namespace plumb
