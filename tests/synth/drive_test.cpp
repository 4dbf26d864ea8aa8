#include "tools/synth/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb::synth {
namespace {

struct Motion {
  double mean = 0.0;
  double sd = 0.0;
};

template <typename Read>
Motion motion_of(const Drive& drive, Read read) {
  double sum = 0.0;
  double square = 0.0;
  int n = 0;
  for (double t = 2.0; t < drive.duration_s() - 0.5; t += 0.05, ++n) {
    const double x = read(drive.state(t));
    sum += x;
    square += x * x;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, square / n - mean * mean))};
}

TEST(Drive, RigidVehicleOnAPlaneKeepsItsCameraHeight) {
  Route route = make_builtin_route("city", 20.0, 3);
  route.flat = true;
  const Terrain terrain(route);
  DriveConfig config;
  config.suspension = 0.0;
  const Drive drive(terrain, config);
  for (double t = 0.0; t < 15.0; t += 0.7) {
    const Se3 T = drive.T_map_cam(t);
    EXPECT_NEAR(T.t.z(), 1.65, 1e-9);
    EXPECT_NEAR(T.R(2, 2), 0.0, 1e-9) << "the optical axis is level";
    EXPECT_NEAR(T.R(2, 1), -1.0, 1e-9) << "y points down";
  }
}

TEST(Drive, SpringsMoveTheBodyLikeARealCar) {
  Route route = make_builtin_route("straight", 60.0, 3);
  route.flat = true;
  const Terrain terrain(route);
  const Drive drive(terrain, DriveConfig{});
  const double degree = 3.14159265 / 180.0;
  const Motion pitch = motion_of(drive, [](const VehicleState& s) { return s.pitch_rad; });
  const Motion heave = motion_of(drive, [](const VehicleState& s) { return s.heave_m; });
  const Motion roll = motion_of(drive, [](const VehicleState& s) { return s.roll_rad; });
  EXPECT_GT(pitch.sd, 0.08 * degree);
  EXPECT_LT(pitch.sd, 0.8 * degree);
  EXPECT_GT(heave.sd, 0.003);
  EXPECT_LT(heave.sd, 0.03);
  EXPECT_GT(roll.sd, 0.05 * degree);
  EXPECT_LT(roll.sd, 1.2 * degree);
}

TEST(Drive, BrakingPitchesTheNoseDown) {
  Route route = make_builtin_route("stop-and-go", 40.0, 3);
  route.flat = true;
  route.setting.roughness = 0.0;
  const Terrain terrain(route);
  const Drive drive(terrain, DriveConfig{});
  double braking = 0.0;
  double pushing = 0.0;
  for (double t = 1.0; t < 35.0; t += 0.02) {
    const VehicleState s = drive.state(t);
    if (s.accel_m_s2 < -1.5) braking = std::max(braking, s.pitch_rad);
    if (s.accel_m_s2 > 1.0) pushing = std::min(pushing, s.pitch_rad);
  }
  EXPECT_GT(braking, 0.005);
  EXPECT_LT(pushing, -0.003);
}

TEST(Drive, TurntableTurnsWithoutMovingTheCamera) {
  const Route route = make_builtin_route("standing", 5.0, 3);
  const Terrain terrain(route);
  DriveConfig config;
  config.yaw_rate_rad_s = 0.5;
  const Drive drive(terrain, config);
  const Se3 a = drive.T_map_cam(0.2);
  const Se3 b = drive.T_map_cam(1.2);
  EXPECT_LT((a.t - b.t).norm(), 1e-3);
  EXPECT_NEAR(log_so3(a.R.transpose() * b.R).norm(), 0.5, 1e-3);
}

TEST(Drive, TurntableTurnsThereAndBackWithinItsTime) {
  const Route route = make_builtin_route("standing", 8.0, 3);
  const Terrain terrain(route);
  DriveConfig config;
  config.yaw_rate_rad_s = 0.3;
  config.turn_from_s = 2.0;
  config.turn_to_s = 6.0;
  const Drive drive(terrain, config);
  const Eigen::Matrix3d R_start = drive.T_map_cam(0.0).R;
  const auto turned = [&](double t) {
    return log_so3(R_start.transpose() * drive.T_map_cam(t).R).norm();
  };
  EXPECT_NEAR(turned(2.0), 0.0, 1e-6);
  EXPECT_NEAR(turned(4.0), 0.6, 1e-3);
  EXPECT_NEAR(turned(7.0), 0.0, 1e-6);
}

TEST(Drive, AKnockTurnsTheCameraAndLeavesItsPlaceAndTheVehicleAlone) {
  const Route route = make_builtin_route("straight", 8.0, 3);
  const Terrain terrain(route);
  DriveConfig config;
  config.mount.yaw_rad = 0.01;
  const Drive before(terrain, config);
  config.knock.at_s = 3.0;
  config.knock.yaw_rad = 0.05;
  const Drive drive(terrain, config);
  for (const double t : {0.5, 2.999, 3.0, 6.0}) {
    const Se3 T_before_knocked = before.T_map_cam(t).inverse() * drive.T_map_cam(t);
    EXPECT_LT(T_before_knocked.t.norm(), 1e-12);
    const Eigen::Vector3d turn_rad = log_so3(T_before_knocked.R);
    EXPECT_NEAR(turn_rad.y(), t < 3.0 ? 0.0 : -0.05, 1e-9)
        << "left, about the axis that points down";
    EXPECT_LT((before.T_map_veh(t).R - drive.T_map_veh(t).R).norm(), 1e-12);
  }
}

TEST(Drive, TheStopRouteStandsAndDrivesOn) {
  const Route route = make_builtin_route("stop", 14.0, 3);
  const Terrain terrain(route);
  const Drive drive(terrain, DriveConfig{});
  EXPECT_GT(drive.state(0.5).speed_m_s, 7.0);
  for (double t = 6.0; t < 9.0; t += 0.1) EXPECT_LT(drive.state(t).speed_m_s, 0.01) << t;
  EXPECT_GT(drive.state(13.0).speed_m_s, 3.0);
}

}  // namespace
}  // namespace plumb::synth
