/// A variance that grows linearly with what a cue believes: the paper's models C.
///
/// Units  of whoever uses it: a variance, and a feature as its cue gives it.
#pragma once

#include <algorithm>
#include <cmath>

namespace plumb {

/// variance = offset + slope * belief, kept in the range that training saw.
struct LinearVariance {
  double offset = 0.0;
  double slope = 0.0;
  double least = 0.0;
  double most = 0.0;
  double mean = 0.0;  ///< over all training frames: what fixed covariances use

  /// A belief that is not finite is none at all.
  [[nodiscard]] double of(double belief) const {
    return std::isfinite(belief) ? std::clamp(offset + slope * belief, least, most) : most;
  }
};

}  // namespace plumb
