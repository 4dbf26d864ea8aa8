/// A variance that depends linearly on one feature: the models C of Song and Chandraker (CVPR 2014,
/// Algorithm 1).
///
/// Units:
///   Those of the caller's variance, and of the feature that the cue gives as its confidence.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

namespace plumb {

/// variance = offset + slope * confidence, kept in the range that training saw.
struct LinearVariance {
  double offset = 0.0;
  double slope = 0.0;
  double least = 0.0;
  double most = 0.0;
  double mean = 0.0;  ///< over all training frames; fixed covariances use it

  /// A confidence that is not finite gives the largest variance.
  [[nodiscard]] double of(double confidence) const {
    return std::isfinite(confidence) ? std::clamp(offset + slope * confidence, least, most) : most;
  }

  /// Visits the numbers as those of one section of a model file.
  template <typename Line, typename Visit>
  static void visit(const char* section, Line& line, Visit&& field) {
    const std::string prefix = std::string(section) + ".";
    field((prefix + "offset").c_str(), line.offset, -10.0, 10.0, "variance at confidence zero");
    field((prefix + "slope").c_str(), line.slope, -10.0, 10.0, "variance per unit of confidence");
    field((prefix + "least").c_str(), line.least, 0.0, 10.0, "smallest variance in training");
    field((prefix + "most").c_str(), line.most, 0.0, 10.0, "largest variance in training");
    field((prefix + "mean").c_str(), line.mean, 0.0, 10.0, "over all frames: the fixed variance");
  }
};

}  // namespace plumb
