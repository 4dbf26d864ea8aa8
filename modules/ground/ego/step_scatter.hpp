/// How far VO's steps scatter, as this drive shows it: the factor on the variance that VO states.
///
/// A vehicle's speed changes smoothly. What a measured speed differs by from the one that the speed
/// filter expects is therefore mostly VO's error. The mean of its square over the last seconds
/// gives a factor for all images. A single image that differs by more is one with a larger error,
/// or one in which the vehicle begins to brake: its own variance grows until the difference is no
/// more than two standard deviations.
///
/// Units:
///   m/s, seconds.
/// Memory:
///   in place.
#pragma once

#include "modules/ground/types/ego_config.hpp"

namespace plumb {

class StepScatter {
 public:
  explicit StepScatter(const EgoConfig& config = {}) : config_(config) {}

  /// Takes the difference of a measured speed from the expected one, the variance of the expected
  /// one, and the variance that VO states. Returns the factor on the latter for this image.
  /// @pre stated_var > 0, dt_s > 0
  [[nodiscard]] double factor(double difference_m_s, double expected_var, double stated_var,
                              double dt_s);

 private:
  EgoConfig config_;
  double mean_factor_ = 1.0;
};

}  // namespace plumb
