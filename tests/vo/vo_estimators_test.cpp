#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "modules/vo/inverse_depth.hpp"
#include "modules/vo/pose.hpp"
#include "modules/vo/projection.hpp"
#include "modules/vo/refine.hpp"
#include "tests/support/central_difference.hpp"
#include "tests/vo/synthetic_window.hpp"

namespace plumb::vo {
namespace {

using test::SyntheticWindow;

const Eigen::Vector2d kFocal(720.0, 710.0);
const Se3 kHostPose{exp_so3({0.02, -0.1, 0.05}), {0.3, -0.2, 0.7}};
const Se3 kFramePose{exp_so3({-0.03, 0.08, 0.01}), {0.1, 0.15, -1.1}};
const Eigen::Vector2d kXy(0.31, 0.12);
constexpr double kRho = 0.11;

Eigen::Vector2d predicted_px(const Se3& T_frame_world, const Se3& T_host_world, double rho) {
  const Se3 T = T_frame_world * T_host_world.inverse();
  const Eigen::Vector3d Y = T.R * kXy.homogeneous() + rho * T.t;
  return kFocal.cwiseProduct(Y.head<2>() / Y.z());
}

Se3 moved(Se3 T, const Vector6d& step) {
  T.R = exp_so3(step.tail<3>()) * T.R;
  T.t = exp_so3(step.tail<3>()) * T.t + step.head<3>();
  return T;
}

TEST(Jacobians, OfTheObservingFrameMatchesCentralDifferences) {
  const Se3 T = kFramePose * kHostPose.inverse();
  const Eigen::Vector3d Y = T.R * kXy.homogeneous() + kRho * T.t;
  const Matrix26d J = frame_jacobian(projection_jacobian(Y, kFocal), Y, kRho);
  const auto f = [](const Vector6d& d) {
    return predicted_px(moved(kFramePose, d), kHostPose, kRho);
  };
  const Matrix26d numeric =
      plumb::test::central_difference<2, 6>(f, Vector6d(Vector6d::Zero()), 1e-6);
  EXPECT_LT((J - numeric).norm(), 1e-5 * numeric.norm());
}

TEST(Jacobians, OfTheHostMatchesCentralDifferences) {
  const Se3 T = kFramePose * kHostPose.inverse();
  const Eigen::Vector3d Y = T.R * kXy.homogeneous() + kRho * T.t;
  const Matrix26d J = host_jacobian(projection_jacobian(Y, kFocal), T.R, kXy, kRho);
  const auto f = [](const Vector6d& d) {
    return predicted_px(kFramePose, moved(kHostPose, d), kRho);
  };
  const Matrix26d numeric =
      plumb::test::central_difference<2, 6>(f, Vector6d(Vector6d::Zero()), 1e-6);
  EXPECT_LT((J - numeric).norm(), 1e-5 * numeric.norm());
}

TEST(Jacobians, OfTheInverseDepthMatchesCentralDifferences) {
  const Se3 T = kFramePose * kHostPose.inverse();
  const Eigen::Vector3d Y = T.R * kXy.homogeneous() + kRho * T.t;
  const Eigen::Vector2d d = projection_jacobian(Y, kFocal) * T.t;
  const Eigen::Vector2d numeric = (predicted_px(kFramePose, kHostPose, kRho + 1e-6) -
                                   predicted_px(kFramePose, kHostPose, kRho - 1e-6)) /
                                  2e-6;
  EXPECT_LT((d - numeric).norm(), 1e-5 * numeric.norm());
}

TEST(Pose, ExactPointsGiveTheExactPose) {
  const SyntheticWindow s(6, 120, 0.0);
  const Se3 truth = s.T_cam_world.back();
  const Se3 start = moved(truth, (Vector6d() << 0.2, -0.1, 0.3, 0.01, -0.02, 0.01).finished());
  const PoseFit fit = fit_pose(start, s.tracks, s.window, s.focal_px, {20, 1.0, false});
  EXPECT_LT((fit.T_cam_world.t - truth.t).norm(), 1e-6);
  EXPECT_LT(log_so3(fit.T_cam_world.R.transpose() * truth.R).norm(), 1e-7);
  EXPECT_EQ(fit.num_inliers, 120);
}

TEST(Pose, ItsInformationPredictsItsError) {
  double sum = 0.0;
  constexpr int kTrials = 60;
  for (unsigned seed = 1; seed <= kTrials; ++seed) {
    const SyntheticWindow s(6, 150, kPixelStd, seed);
    const Se3 truth = s.T_cam_world.back();
    const PoseFit fit = fit_pose(truth, s.tracks, s.window, s.focal_px, {20, 1.0, false});
    // fit = (exp(w), d) truth
    const Eigen::Matrix3d R_error = fit.T_cam_world.R * truth.R.transpose();
    Vector6d e;
    e.head<3>() = fit.T_cam_world.t - R_error * truth.t;
    e.tail<3>() = log_so3(R_error);
    sum += e.dot(fit.information * e) / 6.0;
  }
  // With Gaussian noise, the Cauchy weights state about a third less information than there is.
  EXPECT_GT(sum / kTrials, 0.5);
  EXPECT_LT(sum / kTrials, 1.3);
}

TEST(Pose, WithRotationOnlyTheCameraCentreStays) {
  const SyntheticWindow s(6, 120, 0.0);
  const Se3 truth = s.T_cam_world.back();
  const Eigen::Matrix3d E = exp_so3({0.0, 0.01, 0.0});
  const PoseFit fit =
      fit_pose({E * truth.R, E * truth.t}, s.tracks, s.window, s.focal_px, {20, 1.0, true});
  EXPECT_LT((fit.T_cam_world.inverse().t - truth.inverse().t).norm(), 1e-9);
  EXPECT_LT(log_so3(fit.T_cam_world.R.transpose() * truth.R).norm(), 1e-8);
}

TEST(InverseDepth, ConvergesFromAWrongStart) {
  SyntheticWindow s(6, 60, 0.0);
  for (const int index : s.tracks.active()) {
    Track& track = s.tracks[index];
    track.rho *= 1.7;
    track.prior_std = 100.0;
    refine_inverse_depth(track, s.window, s.focal_px, 20);
    EXPECT_NEAR(track.rho, s.rho[static_cast<std::size_t>(index)], 1e-5);
  }
}

TEST(InverseDepth, WithoutParallaxThePriorStays) {
  SyntheticWindow s(2, 20, 0.0);
  s.window[1].T_cam_world = s.window[0].T_cam_world;
  for (const int index : s.tracks.active()) {
    Track& track = s.tracks[index];
    track.observe(1, track.host_xy);
    track.prior_std = 0.05;
    const double before = track.rho;
    for (int i = 0; i < 100; ++i) refine_inverse_depth(track, s.window, s.focal_px, 4);
    EXPECT_NEAR(track.rho, before, 1e-12);
    EXPECT_NEAR(track.rho_std, 0.05, 1e-9);
  }
}

TEST(InverseDepth, ChangingTheHostKeepsThePoint) {
  SyntheticWindow s(6, 60, 0.0);
  for (const int index : s.tracks.active()) {
    Track& track = s.tracks[index];
    const int old_host = track.host;
    const Eigen::Vector3d p_world =
        s.window[old_host].T_cam_world.inverse() * (track.host_xy.homogeneous() / track.rho);
    ASSERT_TRUE(change_host(track, old_host, s.window));
    EXPECT_EQ(track.host, old_host + 1);
    const Eigen::Vector3d same =
        s.window[track.host].T_cam_world.inverse() * (track.host_xy.homogeneous() / track.rho);
    EXPECT_LT((same - p_world).norm(), 1e-8);
  }
}

void disturb(SyntheticWindow& s) {
  for (int slot = 1; slot <= s.last_slot(); ++slot) {
    const double k = slot;
    s.window[slot].T_cam_world =
        moved(s.window[slot].T_cam_world,
              (Vector6d() << 0.01 * k, -0.02, 0.02, 0.001, -0.002 * std::sin(k), 0.001).finished());
  }
  for (const int index : s.tracks.active()) s.tracks[index].rho *= 1.0 + 0.1 * std::sin(index);
}

// Returns the estimated length of the whole path as a ratio to the true one. Only this scale can
// drift when a single frame is constant.
double scale_of(const SyntheticWindow& s) {
  return s.window[s.last_slot()].T_cam_world.inverse().t.norm() /
         s.T_cam_world.back().inverse().t.norm();
}

TEST(Refine, WithoutNoiseItFindsTheTruthUpToScale) {
  SyntheticWindow s(6, 200, 0.0);
  disturb(s);
  WindowRefiner refiner(600);
  refiner.refine(s.window, s.tracks, s.focal_px, 1, 60);
  const double scale = scale_of(s);
  for (int slot = 0; slot <= s.last_slot(); ++slot) {
    const Se3& truth = s.T_cam_world[static_cast<std::size_t>(slot)];
    const Se3& found = s.window[slot].T_cam_world;
    EXPECT_LT(log_so3(found.R.transpose() * truth.R).norm(), 2e-5) << slot;
    EXPECT_LT((found.t / scale - truth.t).norm(), 2e-3) << slot;
  }
  for (const int index : s.tracks.active()) {
    EXPECT_NEAR(s.tracks[index].rho * scale / s.rho[static_cast<std::size_t>(index)], 1.0, 5e-3);
  }
}

TEST(Refine, FixedKeyframesStayAndCarryTheScale) {
  SyntheticWindow s(8, 200, 0.0);
  for (int slot = 4; slot <= s.last_slot(); ++slot) {
    s.window[slot].T_cam_world.t += Eigen::Vector3d(0.05, -0.03, 0.1);
  }
  WindowRefiner refiner(600);
  refiner.refine(s.window, s.tracks, s.focal_px, 4, 40);
  for (int slot = 0; slot <= s.last_slot(); ++slot) {
    const Se3& truth = s.T_cam_world[static_cast<std::size_t>(slot)];
    const Se3& found = s.window[slot].T_cam_world;
    if (slot < 4) {
      EXPECT_EQ(found.t, truth.t) << slot;
    }
    EXPECT_LT((found.t - truth.t).norm(), 1e-4) << slot;
  }
}

TEST(Refine, WithNoiseTheStandardDeviationsOfInverseDepthsAreConsistent) {
  double sum = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SyntheticWindow s(8, 250, kPixelStd, seed);
    WindowRefiner refiner(600);
    refiner.refine(s.window, s.tracks, s.focal_px, 4, 10);
    for (const int index : s.tracks.active()) {
      const Track& track = s.tracks[index];
      const double e = (track.rho - s.rho[static_cast<std::size_t>(index)]) / track.rho_std;
      sum += e * e;
      ++count;
    }
  }
  EXPECT_GT(sum / count, 0.5);
  EXPECT_LT(sum / count, 1.6);
}

TEST(Refine, OneWildTrackDoesNotMoveTheFrames) {
  SyntheticWindow s(8, 200, 0.0);
  Track& wild = s.tracks[s.tracks.active()[0]];
  for (int slot = wild.host + 1; slot <= s.last_slot(); ++slot) {
    wild.observe(slot, wild.xy_in(slot) + Eigen::Vector2d(0.02, -0.05));
  }
  WindowRefiner refiner(600);
  refiner.refine(s.window, s.tracks, s.focal_px, 4, 20);
  for (int slot = 0; slot <= s.last_slot(); ++slot) {
    EXPECT_LT(
        (s.window[slot].T_cam_world.t - s.T_cam_world[static_cast<std::size_t>(slot)].t).norm(),
        5e-3);
  }
  const TrackFit fit = check_track(wild, s.window, s.focal_px, 2.0);
  EXPECT_GT(2 * fit.num_bad, fit.num);
}

}  // namespace
}  // namespace plumb::vo
