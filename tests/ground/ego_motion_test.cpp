#include "modules/ground/ego/ego_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "modules/ground/filter/plane_angles.hpp"
#include "tests/ground/road_scene.hpp"

namespace plumb {
namespace {

constexpr double kDtS = 0.1;

/// Runs EgoMotion over a scripted drive with a scale that is known from `first_scale_frame` on.
struct Rig {
  explicit Rig(const test::Drive& drive, int num_frames) : poses(drive.poses(num_frames)) {}

  const EgoOutput& step(int k, const std::function<void(VoOutput*)>& change = nullptr) {
    VoOutput vo;
    test::script_vo(poses, k, script, &vo);
    if (k < first_window_frame) vo.window.clear();
    if (change) change(&vo);
    ScaleEstimate scale;
    scale.known = k >= first_scale_frame;
    scale.measured_now = scale.known;
    scale.log_scale = std::log(script.metres_per_vo);
    scale.var = 1e-4;
    ego.update(vo, scale, test::plane_in(poses[static_cast<std::size_t>(k)]).normal_cam, &out);
    return out;
  }

  [[nodiscard]] Se3 truth(int k) const {
    return poses[0].inverse() * poses[static_cast<std::size_t>(k)];
  }

  std::vector<Se3> poses;
  test::VoScript script;
  int first_scale_frame = 4;
  int first_window_frame = 0;
  EgoMotion ego;
  EgoOutput out;
};

void expect_pose(const Se3& seen, const Se3& truth, double tolerance) {
  EXPECT_TRUE(seen.t.isApprox(truth.t, tolerance))
      << seen.t.transpose() << " / " << truth.t.transpose();
  EXPECT_TRUE(seen.R.isApprox(truth.R, tolerance));
}

TEST(EgoMotion, CatchesUpWithTheStartWhenTheScaleArrives) {
  test::Drive drive;
  drive.turn_left_rad = 0.02;
  drive.pitch_amplitude_rad = 0.005;
  Rig rig(drive, 40);
  for (int k = 0; k < 4; ++k) {
    const EgoOutput& out = rig.step(k);
    EXPECT_EQ(out.status, EgoStatus::kInitializing);
    expect_pose(out.T_world_cam, Se3{}, 1e-12);
  }
  for (int k = 4; k < 40; ++k) {
    const EgoOutput& out = rig.step(k);
    EXPECT_EQ(out.status, EgoStatus::kOk);
    expect_pose(out.T_world_cam, rig.truth(k), 1e-9);
  }
  EXPECT_EQ(rig.out.reset_counter, 0);
}

TEST(EgoMotion, CatchesUpByChainingWhenTheWindowDoesNotReachBack) {
  Rig rig(test::Drive{}, 30);
  rig.script.first_ok_frame = 1;
  rig.first_scale_frame = 20;
  for (int k = 0; k < 30; ++k) rig.step(k);
  expect_pose(rig.out.T_world_cam, rig.truth(29), 1e-9);
  EXPECT_EQ(rig.out.reset_counter, 0);
}

TEST(EgoMotion, LeftTurnsHavePositiveYawRate) {
  test::Drive drive;
  drive.turn_left_rad = 0.03;
  Rig rig(drive, 8);
  for (int k = 0; k < 8; ++k) rig.step(k);
  EXPECT_NEAR(rig.out.rate_ground_rad_s.z(), 0.03 / kDtS, 1e-6);
  EXPECT_NEAR(rig.out.rate_ground_rad_s.x(), 0.0, 1e-6);
  EXPECT_GT(rig.out.velocity_ground_m_s.x(), 0.0);
}

TEST(EgoMotion, VelocityIsAlongTheRoadHoweverTheCameraIsMounted) {
  test::Drive drive;
  drive.mount_pitch_rad = 0.1;
  drive.mount_roll_rad = -0.08;
  Rig rig(drive, 8);
  for (int k = 0; k < 8; ++k) rig.step(k);
  EXPECT_TRUE(
      rig.out.velocity_ground_m_s.isApprox(Eigen::Vector3d(drive.step_m / kDtS, 0, 0), 1e-2));
  EXPECT_NEAR(rig.out.velocity_ground_m_s.z(), 0.0, 1e-6);
}

TEST(EgoMotion, FindsTheAccelerationOfASteadilyBrakingCar) {
  Rig rig(test::Drive{}, 60);
  rig.poses.clear();
  for (int k = 0; k < 60; ++k) {
    const double t = k * kDtS;
    rig.poses.push_back({Eigen::Matrix3d::Identity(), {0.0, 0.0, 20.0 * t - 0.5 * 1.5 * t * t}});
  }
  for (int k = 0; k < 60; ++k) {
    rig.step(k);
    EXPECT_EQ(std::isnan(rig.out.accel_forward_m_s2), k < 6) << k;
  }
  EXPECT_NEAR(rig.out.accel_forward_m_s2, -1.5, 0.1);
  EXPECT_GT(rig.out.accel_forward_std_m_s2, 0.0);
}

TEST(EgoMotion, StandingStillChangesNothing) {
  Rig rig(test::Drive{}, 12);
  for (int k = 0; k < 12; ++k) rig.step(k);
  const Se3 before = rig.out.T_world_cam;
  const double distance = rig.out.distance_m;
  VoOutput vo;
  for (int k = 12; k < 50; ++k) {
    vo = VoOutput{};
    vo.seq = k;
    vo.prev_seq = k - 1;
    vo.capture_us = 100'000LL * k + 1'000'000;
    vo.interval_s = kDtS;
    vo.status = VoStatus::kStandstill;
    ScaleEstimate scale{true, false, 0.26, 1e-4, 1.0};
    rig.ego.update(vo, scale, Eigen::Vector3d::UnitY(), &rig.out);
    EXPECT_EQ(rig.out.status, EgoStatus::kStandstill);
    EXPECT_LT(rig.out.speed_std_m_s, 0.02);
  }
  expect_pose(rig.out.T_world_cam, before, 1e-12);
  EXPECT_EQ(rig.out.distance_m, distance);
  EXPECT_EQ(rig.out.velocity_ground_m_s.norm(), 0.0);
}

TEST(EgoMotion, JitterOfTheStampsWidensTheSpeedAndNotTheMotion) {
  Rig sure(test::Drive{}, 20), jittery(test::Drive{}, 20);
  for (int k = 0; k < 20; ++k) {
    sure.step(k);
    jittery.step(k, [](VoOutput* vo) { vo->interval_std_s = 0.04 * vo->interval_s; });
  }
  const double added_m_s = 0.04 * jittery.out.velocity_ground_m_s.x();
  EXPECT_NEAR(jittery.out.speed_std_m_s, std::hypot(sure.out.speed_std_m_s, added_m_s),
              0.1 * added_m_s);
  EXPECT_GT(jittery.out.accel_forward_std_m_s2, sure.out.accel_forward_std_m_s2);
}

TEST(EgoMotion, CoastsWithAGrowingDeviation) {
  Rig rig(test::Drive{}, 20);
  for (int k = 0; k < 12; ++k) rig.step(k);
  const double sure = rig.out.cov_world_cam(2, 2);
  double last = sure;
  for (int k = 12; k < 16; ++k) {
    rig.step(k, [](VoOutput* vo) { vo->status = VoStatus::kCoasting; });
    EXPECT_EQ(rig.out.status, EgoStatus::kCoasting);
    EXPECT_GT(rig.out.cov_world_cam(2, 2), last);
    last = rig.out.cov_world_cam(2, 2);
  }
  EXPECT_GT(last, 2.0 * sure);
  expect_pose(rig.out.T_world_cam, rig.truth(15), 1e-9);
  EXPECT_EQ(rig.out.reset_counter, 0);
}

TEST(EgoMotion, LosesContinuityOnceWhenLost) {
  Rig rig(test::Drive{}, 30);
  for (int k = 0; k < 12; ++k) rig.step(k);
  const Se3 before = rig.out.T_world_cam;
  const auto lost = [](VoOutput* vo) {
    vo->status = VoStatus::kLost;
    vo->window.clear();
  };
  for (int k = 12; k < 16; ++k) {
    rig.step(k, lost);
    EXPECT_EQ(rig.out.status, EgoStatus::kLost);
    expect_pose(rig.out.T_world_cam, before, 1e-12);
    EXPECT_EQ(rig.out.reset_counter, 1);
  }
  for (int k = 16; k < 20; ++k) rig.step(k, [](VoOutput* vo) { vo->window.clear(); });
  EXPECT_EQ(rig.out.reset_counter, 1);
  EXPECT_NEAR((rig.out.T_world_cam.t - before.t).norm(), 4 * test::Drive{}.step_m, 1e-6);
}

TEST(EgoMotion, BridgesAMissingMessageWithTheWindow) {
  Rig rig(test::Drive{}, 20);
  for (int k = 0; k < 20; ++k) {
    if (k == 11 || k == 12) continue;
    rig.step(k);
  }
  expect_pose(rig.out.T_world_cam, rig.truth(19), 1e-9);
  EXPECT_EQ(rig.out.reset_counter, 0);
}

TEST(EgoMotion, ScaleErrorAddsUpAlongThePathNotLikeNoise) {
  Rig rig(test::Drive{}, 60);
  rig.first_scale_frame = 2;
  for (int k = 0; k < 60; ++k) rig.step(k);
  // The error is 1 % of the distance, because every step had the same scale error.
  EXPECT_NEAR(std::sqrt(rig.out.cov_world_cam(2, 2)), 0.01 * rig.out.distance_m,
              0.002 * rig.out.distance_m);
}

}  // namespace
}  // namespace plumb
