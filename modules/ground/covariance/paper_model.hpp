/// Models C of the paper: how far a cue's error scatters, by the belief in it.
///
/// Units  heights and widths in metres, beliefs as the cues give them.
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

struct PaperModel {
  LinearVariance dense_n1;
  LinearVariance dense_n3;
  LinearVariance dense_h;   ///< [m^2]
  LinearVariance points_h;  ///< [m^2]
};

}  // namespace plumb
