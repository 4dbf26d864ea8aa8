/// Fits how the variance of an error depends on features of the frame: the most likely LogVariance.
///
/// It minimises over (ln_var, slopes) the sum of w (ln V + min-clipped e^2 / V) / 2 with V =
/// exp(ln_var + slopes . f) + extra, plus a prior for slopes that the data do not determine. Slopes
/// below zero are set to zero: a feature never makes a cue better than in a usual frame.
#pragma once

#include <vector>

#include "modules/ground/covariance/ground_model.hpp"

namespace plumb {

struct VarianceRow {
  double error = 0.0;
  double extra_var = 0.0;  ///< known part that is not the cue's: noise of the reference
  double weight = 1.0;
  CueFeatures features{};
};

/// Prior of the slopes; a slope whose 1-sigma is 0 stays at its mean.
struct SlopePrior {
  CueFeatures mean{};
  CueFeatures std{};
};

struct VarianceBounds {
  double low_std = 0.0;
  double high_std = 0.0;
};

/// @pre `rows` is not empty, and weights are above zero.
[[nodiscard]] LogVariance fit_log_variance(const std::vector<VarianceRow>& rows,
                                           const SlopePrior& prior, const VarianceBounds& bounds);

/// Means over rows of e^2 / V (nees) and of the Gaussian log-likelihood.
struct VarianceScore {
  int num = 0;
  double nees = 0.0;
  double log_likelihood = 0.0;
};

/// Accumulates (error, variance) pairs.
class ScoreSum {
 public:
  void add(double error, double var);
  /// The means are NaN without any pair.
  [[nodiscard]] VarianceScore mean() const;

 private:
  VarianceScore sum_;
};

}  // namespace plumb
