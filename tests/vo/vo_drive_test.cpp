/// Tests the whole odometry on rendered drives with exact truth.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "tests/vo/drive_fixture.hpp"

namespace plumb {
namespace {

using test::Drive;
using test::drive;
using test::mean_step;
using test::RenderedImage;

double rotation_error(const Se3& a, const Se3& b) { return log_so3(a.R.transpose() * b.R).norm(); }

TEST(Drive, AheadAndThroughABendItMeasuresEveryMotion) {
  std::vector<Se3> poses = drive(15, 0.8);
  const Se3 turn{exp_so3({0.0, 0.015, 0.0}), {0.0, 0.0, 0.8}};
  for (int i = 0; i < 15; ++i) poses.push_back(poses.back() * turn);
  Drive d;
  for (const Se3& T_world_cam : poses) d.see(T_world_cam);
  EXPECT_EQ(d.results()[0].status, VoStatus::kInitializing);
  EXPECT_EQ(d.results()[0].reason, VoReason::kFirstFrame);
  EXPECT_EQ(d.results()[0].prev_seq, -1);
  const double unit = mean_step(d, 4, poses.size()) / 0.8;
  for (std::size_t i = 4; i < poses.size(); ++i) {
    ASSERT_EQ(d.results()[i].status, VoStatus::kOk) << i;
    const Se3 truth = poses[i - 1].inverse() * poses[i];
    EXPECT_LT(rotation_error(d.results()[i].T_prev_cam, truth), 1.5e-3) << i;
    EXPECT_LT((d.results()[i].T_prev_cam.t / unit - truth.t).norm(), 0.04) << i;
    EXPECT_EQ(d.results()[i].prev_seq, static_cast<std::int64_t>(i) - 1);
    EXPECT_EQ(d.results()[i].scale_epoch, 0);
  }
}

TEST(Drive, EveryMotionFromTheFirstOnHasItsCovariance) {
  const std::vector<Se3> poses = drive(15, 0.8);
  Drive d;
  std::size_t num_ok = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const VoOutput& out = d.see(poses[i]);
    if (out.status != VoStatus::kOk) continue;
    ++num_ok;
    const Eigen::LLT<Matrix6d> factor(out.cov_prev_cam);
    ASSERT_EQ(factor.info(), Eigen::Success) << i;
    EXPECT_GT(out.cov_prev_cam.diagonal().minCoeff(), 1e-12) << i;
    const Se3 truth = poses[i - 1].inverse() * poses[i];
    const Eigen::Vector3d off = log_so3(truth.R.transpose() * out.T_prev_cam.R);
    const Eigen::Matrix3d turn_cov = out.cov_prev_cam.bottomRightCorner<3, 3>();
    EXPECT_LT(off.dot(turn_cov.inverse() * off), 25.0) << i;
  }
  EXPECT_GE(num_ok, poses.size() - 2);
}

TEST(Drive, TheWindowLinksBackToTheFirstFrameWhenItStarts) {
  const std::vector<Se3> poses = drive(12, 0.3);
  Drive d;
  std::size_t i = 0;
  while (i < poses.size() && d.see(poses[i]).status != VoStatus::kOk) ++i;
  ASSERT_LT(i, poses.size());
  ASSERT_EQ(d.last().window.size(), i + 1);
  EXPECT_EQ(d.last().window[0].seq, static_cast<std::int64_t>(i));
  EXPECT_EQ(d.last().window[i].seq, 0);
  const double unit = d.last().window[i].T_window_cam.t.norm() / (0.3 * static_cast<double>(i));
  for (std::size_t k = 0; k <= i; ++k) {
    const WindowPose& w = d.last().window[k];
    const Se3 truth = poses[static_cast<std::size_t>(w.seq)].inverse() * poses[i];
    EXPECT_LT((w.T_window_cam.t / unit - truth.t).norm(), 0.05) << w.seq;
  }
}

TEST(Drive, RoadPointsLieOnTheRoad) {
  Drive d;
  for (const Se3& T : drive(20, 0.8)) d.see(T);
  const double unit = mean_step(d, 10, 20) / 0.8;
  int num_near = 0;
  int num_on_road = 0;
  for (const RoadPoint& p : d.last().road_points) {
    const Eigen::Vector3d p_m = p.p_cam.cast<double>() / unit;
    EXPECT_GT(p_m.y(), 0.0);
    EXPECT_GE(p.num_obs, 3);
    if (p_m.z() > 25.0 || std::abs(p_m.x()) > 6.0) continue;
    ++num_near;
    if (std::abs(p_m.y() - 1.65) < 0.15) ++num_on_road;
  }
  EXPECT_GT(num_near, 10);
  EXPECT_GE(num_on_road, 0.85 * num_near);
}

TEST(Standstill, FiftyNoisyFramesMeasureZeroAndLeaveTheScaleAlone) {
  const std::vector<Se3> before = drive(16, 0.8);
  Drive d;
  for (const Se3& T : before) d.see(T, 2.0);
  const double unit = mean_step(d, 10, 16) / 0.8;
  for (int i = 0; i < 50; ++i) {
    d.see(before.back(), 2.0);
    ASSERT_EQ(d.last().status, VoStatus::kStandstill) << i;
    EXPECT_EQ(d.last().T_prev_cam.t.norm(), 0.0);
    EXPECT_EQ(d.last().num_new, 0);
  }
  Se3 T = before.back();
  for (int i = 0; i < 12; ++i) {
    T.t.z() += 0.8;
    d.see(T, 2.0);
    ASSERT_EQ(d.last().status, VoStatus::kOk) << i;
    EXPECT_EQ(d.last().scale_epoch, 0);
    EXPECT_NEAR(d.last().T_prev_cam.t.norm() / (0.8 * unit), 1.0, 0.03) << i;
  }
}

TEST(Standstill, BeforeTheFirstMotionIsMeasuredToo) {
  Drive d;
  for (int i = 0; i < 10; ++i) {
    d.see(Se3{}, 2.0);
    EXPECT_EQ(d.last().status, i < 5 ? VoStatus::kInitializing : VoStatus::kStandstill) << i;
  }
  for (const Se3& T : drive(12, 0.6)) d.see(T, 2.0);
  EXPECT_EQ(d.last().status, VoStatus::kOk);
}

TEST(Standstill, CreepingAddsUpInsteadOfBeingLost) {
  const std::vector<Se3> before = drive(16, 0.8);
  Drive d;
  for (const Se3& T : before) d.see(T);
  const double unit = mean_step(d, 10, 16) / 0.8;
  Se3 T = before.back();
  double z = 0.0;
  for (int i = 0; i < 60; ++i) {
    T.t.z() += 0.01;
    d.see(T);
    z += d.last().T_prev_cam.t.z() / unit;
  }
  EXPECT_NEAR(z, 0.6, 0.06);
}

TEST(Rotation, TurningOnTheSpotKeepsPositionLandmarksAndScale) {
  const std::vector<Se3> before = drive(16, 0.8);
  Drive d;
  for (const Se3& T : before) d.see(T);
  const double unit = mean_step(d, 10, 16) / 0.8;
  Se3 T = before.back();
  for (int i = 0; i < 12; ++i) {
    T.R = T.R * exp_so3({0.0, 0.004, 0.0});
    d.see(T);
    ASSERT_EQ(d.last().status, VoStatus::kRotationOnly) << i;
    EXPECT_EQ(d.last().T_prev_cam.t.norm(), 0.0) << i;
    EXPECT_NEAR(log_so3(d.last().T_prev_cam.R).y(), 0.004, 4e-4) << i;
  }
  const Eigen::Vector3d ahead = T.R * Eigen::Vector3d(0.0, 0.0, 0.8);
  for (int i = 0; i < 8; ++i) {
    T.t += ahead;
    d.see(T);
    ASSERT_EQ(d.last().status, VoStatus::kOk) << i;
    EXPECT_EQ(d.last().scale_epoch, 0);
  }
  EXPECT_NEAR(mean_step(d, d.results().size() - 6, d.results().size()) / (0.8 * unit), 1.0, 0.04);
}

TEST(Restart, AnotherPlaceGetsANewEpochWithTheSpeedBefore) {
  Drive d;
  for (const Se3& T : drive(16, 0.6)) d.see(T);
  const double before = mean_step(d, 10, 16);
  // Far down the street, no landmark of before is visible.
  Se3 T{Eigen::Matrix3d::Identity(), {0.3, 0.0, 90.0}};
  int restarted_after = -1;
  for (int i = 0; i < 12; ++i) {
    T.t.z() += 0.6;
    d.see(T);
    if (d.last().reason == VoReason::kRestarted) restarted_after = i;
  }
  ASSERT_GE(restarted_after, 0);
  EXPECT_LE(restarted_after, 3);
  EXPECT_EQ(d.last().scale_epoch, 1);
  EXPECT_EQ(d.last().status, VoStatus::kOk);
  EXPECT_NEAR(mean_step(d, d.results().size() - 5, d.results().size()) / before, 1.0, 0.15);
}

TEST(Restart, AfterALongLossTheUnitIsCarriedWithALargerStandardDeviation) {
  Drive d;
  for (const Se3& T : drive(16, 0.6)) d.see(T);
  const double before = mean_step(d, 10, 16);
  const RenderedImage dark{std::vector<std::uint8_t>(620 * 188, 0), 620, 188};
  for (int i = 0; i < 50; ++i) d.show(dark);
  EXPECT_EQ(d.last().status, VoStatus::kLost);
  Se3 T{Eigen::Matrix3d::Identity(), {0.3, 0.0, 16 * 0.6 + 50 * 0.6}};
  double carry_std = 0.0;
  for (int i = 0; i < 12; ++i) {
    T.t.z() += 0.6;
    d.see(T);
    if (d.last().reason == VoReason::kRestarted) carry_std = d.last().scale_carry_std;
  }
  EXPECT_EQ(d.last().status, VoStatus::kOk);
  EXPECT_EQ(d.last().scale_epoch, 1);
  EXPECT_NEAR(mean_step(d, d.results().size() - 5, d.results().size()) / before, 1.0, 0.15);
  EXPECT_GT(carry_std, 0.1) << "five seconds are long";
  EXPECT_LT(carry_std, 2.0);
}

TEST(Start, AtHighSpeedAFewImagesAreEnough) {
  for (const double step : {1.4, 2.0, 2.7}) {
    Drive d;
    int first_ok = -1;
    int i = 0;
    for (const Se3& T : drive(8, step)) {
      d.see(T, 2.0);
      if (first_ok < 0 && d.last().status == VoStatus::kOk) first_ok = i;
      ++i;
    }
    EXPECT_GE(first_ok, 1) << step;
    EXPECT_LE(first_ok, 3) << step;
  }
}

TEST(Input, MissingFramesAreReportedAndBridged) {
  const std::vector<Se3> poses = drive(24, 0.5);
  Drive d;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i == 14 || i == 15) {
      d.skip(1);
      continue;
    }
    d.see(poses[i]);
    if (i == 16) {
      EXPECT_EQ(d.last().reason, VoReason::kFramesMissing);
      EXPECT_EQ(d.last().prev_seq, 13);
      EXPECT_NEAR(d.last().T_prev_cam.t.norm() / (3.0 * d.results()[13].T_prev_cam.t.norm()), 1.0,
                  0.04);
    } else if (i > 5) {
      EXPECT_EQ(d.last().reason, VoReason::kNone) << i;
    }
    if (i <= 5) continue;
    EXPECT_EQ(d.last().status, VoStatus::kOk) << i;
  }
}

TEST(Input, AnImageOfAnotherSizeIsRefused) {
  Drive d;
  for (const Se3& T : drive(6, 0.6)) d.see(T);
  const RenderedImage small{std::vector<std::uint8_t>(320 * 188, 90), 320, 188};
  d.show(small);
  EXPECT_EQ(d.last().status, VoStatus::kLost);
  EXPECT_EQ(d.last().reason, VoReason::kNoCalibration);
  EXPECT_EQ(d.last().prev_seq, -1);
}

TEST(Determinism, TwoInstancesGiveTheSameBits) {
  const std::vector<Se3> poses = drive(25, 0.9, 0.01);
  Drive a;
  Drive b;
  for (const Se3& T : poses) {
    const VoOutput& x = a.see(T);
    const VoOutput& y = b.see(T);
    ASSERT_EQ(x.T_prev_cam.t, y.T_prev_cam.t);
    ASSERT_EQ(x.T_prev_cam.R, y.T_prev_cam.R);
    ASSERT_EQ(x.cov_prev_cam, y.cov_prev_cam);
    ASSERT_EQ(x.num_tracked, y.num_tracked);
    ASSERT_EQ(x.road_points.size(), y.road_points.size());
    for (std::size_t i = 0; i < x.road_points.size(); ++i) {
      ASSERT_EQ(x.road_points[i].p_cam, y.road_points[i].p_cam);
    }
    for (std::size_t i = 0; i < x.window.size(); ++i) {
      ASSERT_EQ(x.window[i].T_window_cam.t, y.window[i].T_window_cam.t);
    }
  }
}

TEST(Distortion, AResidualRadialTermIsTakenIntoAccount) {
  CameraModel camera = test::scene_camera();
  camera.residual_k1 = 0.02;
  Drive d(camera);
  std::vector<Se3> poses = drive(20, 0.8, 0.012);
  for (const Se3& T : poses) d.see(T);
  const double unit = mean_step(d, 4, poses.size()) / 0.8;
  for (std::size_t i = 4; i < poses.size(); ++i) {
    const Se3 truth = poses[i - 1].inverse() * poses[i];
    EXPECT_LT(rotation_error(d.results()[i].T_prev_cam, truth), 1.5e-3) << i;
    EXPECT_LT((d.results()[i].T_prev_cam.t / unit - truth.t).norm(), 0.04) << i;
  }
}

/// Returns the root mean square error of the rotations along a winding path. The rows are exposed
/// over 30 of every 100 ms, while the odometry is given a readout time of `told_s`.
double turn_error_under_rolling_shutter(double told_s) {
  CameraModel shutter = test::scene_camera();
  shutter.readout_s = 0.03;
  CameraModel told = shutter;
  told.readout_s = told_s;
  const test::Scene scene(shutter);
  Drive d(told);
  Se3 T_world_cam;
  Se3 step_before;
  double square_sum = 0.0;
  constexpr int kFirst = 5;
  constexpr int kFrames = 30;
  for (int i = 0; i < kFrames; ++i) {
    const Se3 step{exp_so3({0.0, 0.04 * std::sin(0.4 * i), 0.0}), {0.0, 0.0, 0.6}};
    const VoOutput& out = d.show(scene.render_rolling(T_world_cam, step, 0.1));
    if (i >= kFirst) {
      EXPECT_EQ(out.status, VoStatus::kOk) << i;
      square_sum += std::pow(rotation_error(out.T_prev_cam, step_before), 2);
    }
    T_world_cam = T_world_cam * step;
    step_before = step;
  }
  return std::sqrt(square_sum / (kFrames - kFirst));
}

TEST(RollingShutter, IsUndoneByThePointsOwnMotion) {
  const double told = turn_error_under_rolling_shutter(0.03);
  const double untold = turn_error_under_rolling_shutter(0.0);
  EXPECT_LT(told, 0.7 * untold);
}

}  // namespace
}  // namespace plumb
