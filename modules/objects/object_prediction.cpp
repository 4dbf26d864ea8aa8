#include "modules/objects/object_prediction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numbers.hpp"

namespace plumb {
namespace {

constexpr double kYawTime_s = 2.0;        ///< correlation time of the heading
constexpr double kLogSizeRateStd = 0.01;  ///< [1/sqrt(s)]
/// The height of the road under a nearer object has the effect that it has at this distance.
constexpr double kNearestFoot_m = 3.0;

}  // namespace

double wrapped(double angle_rad) {
  return angle_rad - 2.0 * std::numbers::pi *
                         std::ceil((angle_rad - std::numbers::pi) / (2.0 * std::numbers::pi));
}

double plane_error_var(const TrackView& view, const Eigen::Vector2d& position_m) {
  const double distance_m = position_m.norm();
  const double height_var = square(view.objects.foot_height_std_m) +
                            square(view.objects.cross_slope_std * position_m.y());
  return view.plane.cov(0, 0) + square(view.detections.road_bend_std_rad_m * distance_m) +
         height_var / square(std::max(distance_m, kNearestFoot_m));
}

void predict_state(const TrackView& view, const AxesStep& axes, double dt_s, double heading_rad,
                   StateEstimate* estimate) {
  StateVector& x = estimate->x;
  StateMatrix F = StateMatrix::Identity();
  F(kX, kVelocityX) = F(kY, kVelocityY) = dt_s;
  x = F * x;
  // The state moves into the new ground axes.
  x.head<2>() = axes.R_new_old * (x.head<2>() - axes.t_m);
  x.segment<2>(kVelocityX) = axes.R_new_old * x.segment<2>(kVelocityX).eval();
  x(kYaw) = wrapped(x(kYaw) - axes.yaw_rad);
  StateMatrix turn = StateMatrix::Identity();
  turn.topLeftCorner<2, 2>() = axes.R_new_old;
  turn.block<2, 2>(kVelocityX, kVelocityX) = axes.R_new_old;
  // The error of the plane is a first-order Gauss-Markov process.
  const double keep = std::exp(-dt_s / view.objects.plane_error_time_s);
  turn(kPlaneError, kPlaneError) = keep;
  x(kPlaneError) *= keep;
  // So is the heading. Its mean is the heading,
  // along or across the road, that the track started with.
  const double keep_yaw = std::exp(-dt_s / kYawTime_s);
  turn(kYaw, kYaw) = keep_yaw;
  x(kYaw) = heading_rad + keep_yaw * wrapped(x(kYaw) - heading_rad);
  const StateMatrix A = turn * F;
  StateMatrix& P = estimate->P;
  P = A * P * A.transpose();
  P(kYaw, kYaw) += (1.0 - square(keep_yaw)) * square(kHeadingStd_rad);
  for (const StateRow row : {kLogWidth, kLogRatio, kLogHeight}) {
    P(row, row) += square(kLogSizeRateStd) * dt_s;
  }
  P(kPlaneError, kPlaneError) += (1.0 - keep * keep) * plane_error_var(view, x.head<2>());
}

void add_acceleration(double accel_var, double dt_s, StateEstimate* estimate) {
  StateMatrix& P = estimate->P;
  for (int axis = 0; axis < 2; ++axis) {
    const double both = accel_var * 0.5 * dt_s * square(dt_s);
    P(kX + axis, kX + axis) += accel_var * 0.25 * square(dt_s * dt_s);
    P(kVelocityX + axis, kVelocityX + axis) += accel_var * square(dt_s);
    P(kX + axis, kVelocityX + axis) += both;
    P(kVelocityX + axis, kX + axis) += both;
  }
}

void set_stationary(StateEstimate* estimate) {
  for (const StateRow row : {kVelocityX, kVelocityY}) {
    estimate->x(row) = 0.0;
    estimate->P.row(row).setZero();
    estimate->P.col(row).setZero();
    estimate->P(row, row) = square(kStationarySpeedStd_m_s);
  }
}

}  // namespace plumb
