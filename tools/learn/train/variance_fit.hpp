/// How the scatter of an error follows what is known in a frame: the most likely LogVariance.
///
/// Minimises over (ln_var, slopes) the sum of w (ln V + min-clipped e^2 / V) / 2, V = exp(ln_var + slopes . f) + extra,
/// plus a prior that holds slopes which the data say nothing about. Slopes below zero are set to zero: a feature never
/// makes a cue better than a usual frame.
#pragma once

#include <vector>

#include "modules/ground/covariance/ground_model.hpp"

namespace plumb {

struct VarianceRow {
  double error = 0.0;
  double extra_var = 0.0;  ///< known part that is not the cue's: noise of what it was held against
  double weight = 1.0;
  CueFeatures features{};
};

/// What slopes are taken to be before the data speak; 1-sigma 0: the slope stays there.
struct SlopePrior {
  CueFeatures mean{};
  CueFeatures std{};
};

struct VarianceBounds {
  double low_std = 0.0;
  double high_std = 0.0;
};

/// @pre rows not empty, weights above zero
[[nodiscard]] LogVariance fit_log_variance(const std::vector<VarianceRow>& rows,
                                           const SlopePrior& prior, const VarianceBounds& bounds);

/// Mean over rows of e^2 / V, and of the Gaussian log-likelihood.
struct VarianceScore {
  int num = 0;
  double nees = 0.0;
  double log_likelihood = 0.0;
};

/// Sums up (error, variance) pairs.
class ScoreSum {
 public:
  void add(double error, double var);
  /// NaN without any.
  [[nodiscard]] VarianceScore mean() const;

 private:
  VarianceScore sum_;
};

}  // namespace plumb
