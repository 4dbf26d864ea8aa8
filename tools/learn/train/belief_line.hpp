/// Algorithm 1 of Song and Chandraker 2014: a line that tells a cue's error variance by one belief.
///
/// Beliefs are put into bins of equal count; per bin the errors' second moment (the paper: variance of |error|, 0.36 of
/// it for a normal law, which would make fused deviations too small); a line through the bins.
#pragma once

#include <vector>

#include "modules/ground/covariance/paper_model.hpp"

namespace plumb {

inline constexpr int kNumBeliefBins = 100;

struct Belief {
  double belief = 0.0;
  double error = 0.0;
};

struct BeliefBin {
  double centre = 0.0;    ///< mean belief
  double variance = 0.0;  ///< mean e^2
  int num = 0;
};

/// Bins of equal count, at most `num_bins`, at least two beliefs each. Beliefs need not be sorted.
[[nodiscard]] std::vector<BeliefBin> bin_beliefs(std::vector<Belief> beliefs, int num_bins);

/// Least squares through the bins; bounds and mean out of them. @pre bins not empty
[[nodiscard]] LinearVariance fit_line(const std::vector<BeliefBin>& bins);

}  // namespace plumb
