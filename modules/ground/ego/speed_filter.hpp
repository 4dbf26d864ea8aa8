/// Kalman filter of the forward acceleration from measured speeds: the state is (speed,
/// acceleration), driven by white jerk.
#pragma once

#include <Eigen/Core>

#include "core/numbers.hpp"
#include "modules/ground/types/ego_config.hpp"

namespace plumb {

class SpeedFilter {
 public:
  explicit SpeedFilter(const EgoConfig& config = {}) : config_(config) {}

  void reset() { num_measured_ = 0; }
  /// Takes the mean speed over the last `dt_s`. @pre dt_s > 0
  void update(double speed_m_s, double speed_var, double dt_s);

  /// The last speed minus the one that those before made expect, and the variance of the latter;
  /// NaN for the first speed.
  [[nodiscard]] double innovation_m_s() const { return innovation_m_s_; }
  [[nodiscard]] double expected_var() const { return expected_var_; }
  /// With three speeds, the acceleration is more than the start value.
  [[nodiscard]] bool observable() const { return num_measured_ >= 3; }
  [[nodiscard]] double accel_m_s2() const { return x_(1); }
  [[nodiscard]] double accel_std_m_s2() const;

 private:
  EgoConfig config_;
  int num_measured_ = 0;
  double innovation_m_s_ = kNan;
  double expected_var_ = kNan;
  Eigen::Vector2d x_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d P_ = Eigen::Matrix2d::Zero();
};

}  // namespace plumb
