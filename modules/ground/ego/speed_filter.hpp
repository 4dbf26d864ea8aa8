/// Forward acceleration out of measured speeds: state (speed, acceleration), driven by white jerk.
#pragma once

#include <Eigen/Core>

namespace plumb {

class SpeedFilter {
 public:
  void reset() { num_measured_ = 0; }
  /// A speed that held over the last `dt_s`. @pre dt_s > 0
  void update(double speed_m_s, double speed_var, double dt_s);

  /// Three speeds make an acceleration that is more than the start's guess.
  [[nodiscard]] bool observable() const { return num_measured_ >= 3; }
  [[nodiscard]] double accel_m_s2() const { return x_(1); }
  [[nodiscard]] double accel_std_m_s2() const;

 private:
  int num_measured_ = 0;
  Eigen::Vector2d x_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d P_ = Eigen::Matrix2d::Zero();
};

}  // namespace plumb
