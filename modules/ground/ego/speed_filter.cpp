#include "modules/ground/ego/speed_filter.hpp"

#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
void SpeedFilter::update(double speed_m_s, double speed_var, double dt_s) {
  if (num_measured_ == 0) {
    x_ << speed_m_s, 0.0;
    P_ << speed_var, 0.0, 0.0, square(config_.start_accel_std_m_s2);
    num_measured_ = 1;
    innovation_m_s_ = expected_var_ = kNan;
    return;
  }
  const double dt2 = dt_s * dt_s;
  Eigen::Matrix2d F;
  F << 1.0, dt_s, 0.0, 1.0;
  Eigen::Matrix2d Q;
  Q << dt2 * dt_s / 3.0, dt2 / 2.0, dt2 / 2.0, dt_s;
  x_ = F * x_;
  P_ = F * P_ * F.transpose() + config_.jerk_density_m2_s5 * Q;
  const double S = P_(0, 0) + speed_var;
  const Eigen::Vector2d K = P_.col(0) / S;
  innovation_m_s_ = speed_m_s - x_(0);
  expected_var_ = P_(0, 0);
  x_ += K * innovation_m_s_;
  P_ -= K * K.transpose() * S;
  ++num_measured_;
}

double SpeedFilter::accel_std_m_s2() const { return std::sqrt(P_(1, 1)); }

}  // namespace plumb
