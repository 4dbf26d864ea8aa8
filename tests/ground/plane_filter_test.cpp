#include "modules/ground/filter/plane_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

#include "core/se3.hpp"
#include "tests/ground/plane_observations.hpp"
#include "tests/support/central_difference.hpp"

namespace plumb {
namespace {

constexpr double kStepRatio = 0.6;

using test::path_along;
using test::plane_at;
using test::point_at;

PlaneFilter started(double ln_height) {
  PlaneFilter filter;
  filter.start(Eigen::Vector3d(0.01, 1.0, 0.02).normalized(), ln_height);
  return filter;
}

Eigen::Matrix3d plane_cov() {
  return Eigen::Vector3d(0.007 * 0.007, 0.007 * 0.007, 0.03 * 0.03).asDiagonal();
}

/// Filters one frame of driving straight, in which the plane is measured as `state`.
void drive_frame(PlaneFilter* filter, const Eigen::Vector3d& state) {
  filter->predict(Eigen::Matrix3d::Identity(), kStepRatio);
  const bool used = filter->fuse(plane_at(state, plane_cov())).accepted;
  filter->end_frame(used, !used);
}

TEST(PlaneFilter, JacobiansMatchCentralDifferences) {
  const Eigen::Vector3d x(0.05, -0.08, 0.4);
  const auto normal = [](const Eigen::Vector2d& n13) {
    return normal_of_state(Eigen::Vector3d(n13(0), n13(1), 0.0));
  };
  const auto expected_normal =
      test::central_difference<3, 2>(normal, Eigen::Matrix<double, 2, 1>(x.head<2>()), 1e-6);
  EXPECT_TRUE(normal_jacobian(x).isApprox(expected_normal, 1e-7));
  const auto plane = [](const Eigen::Vector3d& y) {
    return Eigen::Vector3d(normal_of_state(y) * std::exp(-y(2)));
  };
  EXPECT_TRUE(plane_jacobian(x).isApprox(test::central_difference<3, 3>(plane, x, 1e-6), 1e-7));
}

TEST(PlaneFilter, TurnsTheNormalAgainstTheCamera) {
  PlaneFilter filter = started(0.0);
  const Eigen::Vector3d before = filter.normal();
  const Eigen::Matrix3d R_prev_cam = exp_so3(Eigen::Vector3d(-0.02, 0.3, 0.01));
  filter.predict(R_prev_cam, kStepRatio);
  EXPECT_TRUE(filter.normal().isApprox(R_prev_cam.transpose() * before, 1e-12));
}

TEST(PlaneFilter, PredictionIsAsUncertainAsItsJacobianSays) {
  PlaneFilter filter = started(0.0);
  const Eigen::Matrix3d R_prev_cam = exp_so3(Eigen::Vector3d(0.03, 0.5, -0.02));
  const auto predicted = [&](const Eigen::Vector3d& x) {
    const Eigen::Vector3d n = R_prev_cam.transpose() * normal_of_state(x);
    return Eigen::Vector3d(n.x(), n.z(), x(2));
  };
  const Eigen::Matrix3d F = test::central_difference<3, 3>(predicted, filter.state(), 1e-6);
  const Eigen::Matrix3d P = F * filter.cov() * F.transpose();
  filter.predict(R_prev_cam, kStepRatio);
  const Eigen::Matrix3d added = filter.cov() - P;
  EXPECT_NEAR(added(0, 1), 0.0, 1e-10);  // the added noise is independent per component
  EXPECT_GT(added(0, 0), 0.0);
  EXPECT_NEAR(added(0, 0), added(1, 1), 1e-10);
}

TEST(PlaneFilter, ConvergesToWhatItIsTold) {
  PlaneFilter filter = started(0.1);
  const Eigen::Vector3d truth(0.0, 0.03, 0.0);
  for (int k = 0; k < 60; ++k) drive_frame(&filter, truth);
  EXPECT_TRUE(filter.state().isApprox(truth, 0.05));
  EXPECT_LT(filter.ln_height_std(), 0.015);
}

TEST(PlaneFilter, ShrugsOffASingleWildPlane) {
  PlaneFilter filter = started(0.0);
  for (int k = 0; k < 30; ++k) drive_frame(&filter, filter.state());
  const double before = filter.state()(2);
  drive_frame(&filter, filter.state() + Eigen::Vector3d(0.0, 0.0, 0.6));
  EXPECT_NEAR(filter.state()(2), before, 1e-9);
}

TEST(PlaneFilter, ReacquiresAfterALockOut) {
  PlaneFilter filter = started(0.0);
  for (int k = 0; k < 60; ++k) drive_frame(&filter, filter.state());
  // WHEN VO's unit jumps by 30 % and VO does not report it,
  const Eigen::Vector3d truth = filter.state() + Eigen::Vector3d(0.0, 0.0, 0.26);
  int frames = 0;
  while (std::abs(filter.state()(2) - truth(2)) > 0.03 && frames < 100) {
    drive_frame(&filter, truth);
    ++frames;
  }
  // THEN the gate rejects the new height at first and accepts it later.
  EXPECT_GE(frames, 10);
  EXPECT_LE(frames, 30);
}

TEST(PlaneFilter, FollowsAnAnnouncedChangeOfUnitAtOnce) {
  PlaneFilter filter = started(0.0);
  for (int k = 0; k < 60; ++k) drive_frame(&filter, filter.state());
  const Eigen::Vector3d truth = filter.state() + Eigen::Vector3d(0.0, 0.0, 0.15);
  filter.change_unit(0.2);
  for (int k = 0; k < 4; ++k) drive_frame(&filter, truth);
  EXPECT_NEAR(filter.state()(2), truth(2), 0.02);
}

TEST(PlaneFilter, ResetsWhenNothingIsKnownOfTheNewUnit) {
  PlaneFilter filter = started(0.0);
  filter.change_unit(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(filter.started());
}

TEST(PlaneFilter, PointsTellHeightOnlyAsWellAsTheTiltIsKnown) {
  PlaneFilter filter = started(0.0);
  const double var_before = filter.cov()(2, 2);
  // Ten heights ahead, half a degree of tilt moves the height by nine per cent.
  ASSERT_TRUE(
      filter.fuse(point_at(filter.normal() + Eigen::Vector3d(0.0, 0.0, 10.0), 1e-6)).accepted);
  EXPECT_GT(filter.cov()(2, 2), 0.5 * var_before);
  EXPECT_GT(std::abs(filter.cov()(1, 2)), 0.0);
}

TEST(PlaneFilter, DeviationsMatchTheErrorsOfItsOwnModel) {
  std::mt19937 random(20);
  std::normal_distribution<double> normal(0.0, 1.0);
  double sum = 0.0;
  int num = 0;
  for (int run = 0; run < 60; ++run) {
    Eigen::Vector3d truth(0.0, 0.0, 0.0);
    PlaneFilter filter = started(0.1 * normal(random));
    for (int k = 0; k < 60; ++k) {
      // The model's own noise for one reference step: tilt 0.13 degrees, ln h 0.4 %.
      const double tilt = 0.13 * 0.017453292519943295;
      truth +=
          Eigen::Vector3d(tilt * normal(random), tilt * normal(random), 0.004 * normal(random));
      const Eigen::Vector3d seen =
          truth +
          Eigen::Vector3d(0.007 * normal(random), 0.007 * normal(random), 0.03 * normal(random));
      drive_frame(&filter, seen);
      if (k < 20) continue;
      const Eigen::Vector3d e = filter.state() - truth;
      sum += e.dot(filter.cov().inverse() * e) / 3.0;
      ++num;
    }
  }
  const double nees = sum / num;
  EXPECT_GT(nees, 0.7);
  EXPECT_LT(nees, 1.5);
}

constexpr RoadBend kBend{0.006, 6.0, 2.0};

PlaneFilter started_on_bends() {
  PlaneFilter filter(kBend);
  filter.start(Eigen::Vector3d::UnitY(), 0.0);
  return filter;
}

/// Filters one frame of driving straight on a level road towards a plane ahead that differs by
/// `bend`.
void drive_towards_bend(PlaneFilter* filter, double bend) {
  filter->predict(Eigen::Matrix3d::Identity(), kStepRatio);
  filter->fuse(path_along(Eigen::Vector3d::UnitZ(), 0.003 * 0.003));
  const bool used =
      filter->fuse(plane_at({0.0, bend, kBend.height_slope * bend}, plane_cov())).accepted;
  filter->end_frame(used, !used);
}

/// The height by the road's speed: known to 5 %, of which 1 % is new in each image.
PlaneObservation height_by_speed(double ln_height) {
  PlaneObservation observation;
  observation.function = plumb::observe_height;
  observation.value(0) = ln_height;
  observation.cov(0, 0) = 0.01 * 0.01;
  observation.speed_error_var = 0.05 * 0.05;
  observation.first_component = 2;
  return observation;
}

TEST(PlaneFilter, TheRoadsSpeedAloneLeavesItsErrorInTheHeight) {
  PlaneFilter filter = started(0.0);
  for (int i = 0; i < 200; ++i) {
    filter.predict(Eigen::Matrix3d::Identity(), kStepRatio);
    ASSERT_TRUE(filter.fuse(height_by_speed(0.04)).accepted);
  }
  EXPECT_NEAR(filter.state()(2), 0.04, 0.015);
  EXPECT_GT(filter.ln_height_std(), 0.035) << "200 images that share one error are no 200";
  EXPECT_LT(filter.ln_height_std(), 0.06);
}

TEST(PlaneFilter, TheRoadsSpeedFollowsADriftOnceItsErrorIsKnown) {
  PlaneFilter filter = started(0.0);
  const double error = 0.06;
  for (int i = 0; i < 100; ++i) {
    drive_frame(&filter, {0.0, 0.0, 0.0});
    ASSERT_TRUE(filter.fuse(height_by_speed(error)).accepted);
  }
  EXPECT_NEAR(filter.state()(2), 0.0, 0.01);
  for (int i = 1; i <= 60; ++i) {
    filter.predict(Eigen::Matrix3d::Identity(), kStepRatio);
    ASSERT_TRUE(filter.fuse(height_by_speed(error + 0.001 * i)).accepted);
  }
  EXPECT_NEAR(filter.state()(2), 0.06, 0.02);
}

TEST(PlaneFilter, ADoubtedHeightFollowsTheRoadsSpeedAgain) {
  PlaneFilter filter = started(0.0);
  for (int i = 0; i < 100; ++i) {
    drive_frame(&filter, {0.0, 0.0, -0.1});
    filter.fuse(height_by_speed(0.0));
  }
  EXPECT_NEAR(filter.state()(2), -0.1, 0.02);
  filter.doubt_height(0.1 * 0.1);
  filter.predict(Eigen::Matrix3d::Identity(), kStepRatio);
  ASSERT_TRUE(filter.fuse(height_by_speed(0.0)).accepted);
  EXPECT_NEAR(filter.state()(2), 0.0, 0.04);
  EXPECT_NEAR(filter.ln_height_std(), 0.05, 0.01);
}

TEST(PlaneFilter, TellsTheRoadAheadFromTheRoadUnderTheCar) {
  PlaneFilter filter = started_on_bends();
  for (int k = 0; k < 80; ++k) drive_towards_bend(&filter, 0.02);
  EXPECT_NEAR(filter.ahead()(1), 0.02, 0.002);
  EXPECT_NEAR(filter.ahead()(2), 0.04, 0.005);
  EXPECT_NEAR(filter.state()(1), 0.0, 0.002);
  EXPECT_NEAR(filter.state()(2), 0.0, 0.005);  // the scale depends on this plane
}

TEST(PlaneFilter, WithoutBendsBothPlanesAreOne) {
  PlaneFilter filter = started(0.0);
  for (int k = 0; k < 30; ++k) drive_frame(&filter, {0.0, 0.02, 0.04});
  EXPECT_TRUE(filter.ahead().isApprox(filter.state(), 1e-12));
  EXPECT_TRUE(filter.ahead_cov().isApprox(filter.cov(), 1e-12));
}

TEST(PlaneFilter, BelievesInBendsAsFarAsTheDriveHasShownThem) {
  PlaneFilter flat = started_on_bends();
  PlaneFilter hilly = started_on_bends();
  for (int k = 0; k < 200; ++k) {
    drive_towards_bend(&flat, 0.0);
    drive_towards_bend(&hilly, 0.02 * std::sin(0.06 * k));  // 60 camera heights from crest to crest
  }
  const auto moved_by_one = [](PlaneFilter filter) {
    const double before = filter.ahead()(1);
    drive_towards_bend(&filter, before + 0.01);
    return filter.ahead()(1) - before;
  };
  EXPECT_GT(moved_by_one(hilly), 1.5 * moved_by_one(flat));
  EXPECT_GT(moved_by_one(flat), 0.0);
}

TEST(PlaneFilter, PlaneAheadVariesByTheBendUntilItIsSeen) {
  PlaneFilter filter = started_on_bends();
  const double bend_var = kBend.start_std * kBend.start_std;
  EXPECT_NEAR(filter.ahead_cov()(1, 1) - filter.cov()(1, 1), bend_var, 1e-12);
  EXPECT_NEAR(filter.ahead_var(Eigen::RowVector3d::UnitZ()), 4.0 * bend_var, 1e-12);
  EXPECT_NEAR(filter.ahead_var(Eigen::RowVector3d::Zero()), filter.cov()(2, 2), 1e-12);
}

TEST(PlaneFilter, DeviationsMatchTheErrorsOfARoadThatBends) {
  std::mt19937 random(21);
  std::normal_distribution<double> normal(0.0, 1.0);
  const double keep = std::exp(-kStepRatio / kBend.correlation_length_ratio);
  const double tilt = 0.13 * 0.017453292519943295;
  double ahead_sum = 0.0, here_sum = 0.0;
  int num = 0;
  for (int run = 0; run < 60; ++run) {
    Eigen::Vector4d truth = Eigen::Vector4d::Zero();
    PlaneFilter filter = started_on_bends();
    for (int k = 0; k < 60; ++k) {
      truth += Eigen::Vector4d(tilt * normal(random), tilt * normal(random), 0.004 * normal(random),
                               0.0);
      truth(3) = keep * truth(3) + std::sqrt(1.0 - keep * keep) * kBend.start_std * normal(random);
      const Eigen::Vector3d ahead(truth(0), truth(1) + truth(3),
                                  truth(2) + kBend.height_slope * truth(3));
      filter.predict(Eigen::Matrix3d::Identity(), kStepRatio);
      const double slope = truth(1) + 0.003 * normal(random);
      filter.fuse(path_along(Eigen::Vector3d(0.0, -slope, 1.0).normalized(), 0.003 * 0.003));
      const Eigen::Vector3d seen =
          ahead +
          Eigen::Vector3d(0.007 * normal(random), 0.007 * normal(random), 0.03 * normal(random));
      ASSERT_TRUE(filter.fuse(plane_at(seen, plane_cov())).accepted);
      filter.end_frame(true, false);
      if (k < 20) continue;
      const Eigen::Vector3d e_ahead = filter.ahead() - ahead;
      const Eigen::Vector3d e_here = filter.state() - truth.head<3>();
      ahead_sum += e_ahead.dot(filter.ahead_cov().inverse() * e_ahead) / 3.0;
      here_sum += e_here.dot(filter.cov().inverse() * e_here) / 3.0;
      ++num;
    }
  }
  EXPECT_GT(ahead_sum / num, 0.7);
  EXPECT_LT(ahead_sum / num, 1.5);
  EXPECT_GT(here_sum / num, 0.7);
  EXPECT_LT(here_sum / num, 1.5);
}

}  // namespace
}  // namespace plumb
