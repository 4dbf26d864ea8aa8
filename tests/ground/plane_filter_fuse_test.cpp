/// Tests the filter's update against values calculated by hand, its measurement functions, and the
/// effect of its settings.
#include <gtest/gtest.h>

#include <cmath>

#include "modules/ground/filter/plane_filter.hpp"
#include "tests/ground/plane_observations.hpp"
#include "tests/support/central_difference.hpp"

namespace plumb {
namespace {

using test::pitch_of_road;
using test::plane_at;
using test::point_at;

/// A filter whose first covariance is known by hand: n = (0, 1, 0), ln h = 0, P = diag(1, 1, 4)
/// 1e-4.
PlaneFilter hand_calculated(FilterConfig config = {}) {
  config.start_tilt_std_rad = 0.01;
  config.start_ln_height_std = 0.02;
  PlaneFilter filter({}, config);
  filter.start(Eigen::Vector3d::UnitY(), 0.0);
  return filter;
}

TEST(PlaneFilterFuse, GivesInnovationAndTestRatioOfAScalar) {
  PlaneFilter filter = hand_calculated();
  // y = 0.04 - 0, S = 1e-4 + 3e-4 = 4e-4, e^2 = 16e-4 / 4e-4 = 4, gate 16.
  const FuseResult result = filter.fuse(pitch_of_road(0.04, 3e-4));
  EXPECT_TRUE(result.accepted);
  EXPECT_DOUBLE_EQ(result.innovation(1), 0.04);
  EXPECT_TRUE(std::isnan(result.innovation(0)));
  EXPECT_TRUE(std::isnan(result.innovation(2)));
  EXPECT_NEAR(result.test_ratio, 0.25, 1e-12);
  // Student-t with nu = 4: R grows by (4 + 4) / 5, so K = 1e-4 / (1e-4 + 4.8e-4).
  EXPECT_NEAR(filter.state()(1), 0.04 / 5.8, 1e-12);
  EXPECT_NEAR(filter.cov()(1, 1), 1e-4 * 4.8 / 5.8, 1e-15);
}

TEST(PlaneFilterFuse, GivesInnovationAndTestRatioOfAPlane) {
  PlaneFilter filter = hand_calculated();
  const Eigen::Matrix3d R = Eigen::Vector3d(3e-4, 3e-4, 5e-4).asDiagonal();
  // S = diag(4, 4, 9) 1e-4; y = (0.02, 0.04, 0.03): e^2 = (1 + 4 + 1) / 3 = 2, gate 8.
  const FuseResult result = filter.fuse(plane_at({0.02, 0.04, 0.03}, R));
  EXPECT_TRUE(result.accepted);
  EXPECT_TRUE(result.innovation.isApprox(Eigen::Vector3d(0.02, 0.04, 0.03), 1e-12));
  EXPECT_NEAR(result.test_ratio, 0.25, 1e-12);
  // R grows by (4 + 2) / 5.
  EXPECT_NEAR(filter.state()(0), 0.02 * 1.0 / (1.0 + 3.6), 1e-12);
  EXPECT_NEAR(filter.state()(2), 0.03 * 4.0 / (4.0 + 6.0), 1e-12);
}

TEST(PlaneFilterFuse, RejectsBeyondTheGateAndChangesNothing) {
  PlaneFilter filter = hand_calculated();
  const Eigen::Matrix3d before = filter.cov();
  // e^2 = 0.09^2 / 4e-4 = 20.25 exceeds the gate of 16.
  const FuseResult result = filter.fuse(pitch_of_road(0.09, 3e-4));
  EXPECT_FALSE(result.accepted);
  EXPECT_NEAR(result.test_ratio, 20.25 / 16.0, 1e-12);
  EXPECT_DOUBLE_EQ(result.innovation(1), 0.09);
  EXPECT_EQ(filter.state()(1), 0.0);
  EXPECT_EQ(filter.cov(), before);
  FilterConfig wide;
  wide.scalar_gate = 25.0;
  PlaneFilter lenient = hand_calculated(wide);
  EXPECT_TRUE(lenient.fuse(pitch_of_road(0.09, 3e-4)).accepted);
}

TEST(PlaneFilterFuse, UngatedObservationsHaveNoTestRatio) {
  PlaneFilter filter = hand_calculated();
  const FuseResult result = filter.fuse(filter.level_roll());
  EXPECT_TRUE(result.accepted);
  EXPECT_TRUE(std::isnan(result.test_ratio));
}

TEST(PlaneFilterFuse, APointAboveTheCameraIsNoRoad) {
  PlaneFilter filter = hand_calculated();
  const FuseResult result = filter.fuse(point_at({0.0, -1.0, 10.0}, 1e-4));
  EXPECT_FALSE(result.accepted);
  EXPECT_TRUE(std::isnan(result.test_ratio));
  EXPECT_EQ(filter.state()(2), 0.0);
}

TEST(PlaneFilterFuse, MeasurementFunctionsHaveTheJacobiansOfTheirInnovations) {
  const Eigen::Vector3d plane(0.05, -0.08, 0.4);
  const struct {
    MeasurementFunction function;
    Eigen::Vector3d value;
  } cases[] = {{observe_plane, {0.1, 0.2, 0.3}},
               {observe_point, {1.0, 1.6, 12.0}},
               {observe_pitch, {0.02, 0.0, 0.0}},
               {observe_direction, Eigen::Vector3d(0.05, 0.02, 1.0).normalized()},
               {observe_level, {0.0, 0.0, 0.0}}};
  for (const auto& one : cases) {
    const auto innovation = [&](const Eigen::Vector3d& x) {
      return Eigen::Vector3d(one.function(one.value, x).innovation);
    };
    const Eigen::Matrix3d expected = -test::central_difference<3, 3>(innovation, plane, 1e-6);
    EXPECT_LT((one.function(one.value, plane).jacobian - expected).norm(), 1e-7);
  }
}

TEST(PlaneFilterSettings, ProcessNoiseAndStartValuesTakeEffect) {
  FilterConfig config;
  config.turn_noise_rad = 0.0;
  config.curvature_noise_rad = 0.01;
  config.scale_drift_std = 0.05;
  config.turn_scale_drift_std = 0.0;
  PlaneFilter filter = hand_calculated(config);
  filter.predict(Eigen::Matrix3d::Identity(), 0.6);  // one reference step, straight on
  EXPECT_NEAR(filter.cov()(1, 1), 1e-4 + 1e-4, 1e-12);
  EXPECT_NEAR(filter.cov()(2, 2), 4e-4 + 25e-4, 1e-12);
}

TEST(PlaneFilterSettings, ConvergenceAndLockOutAreConfigured) {
  FilterConfig config;
  config.converged_ln_std = 0.01;
  EXPECT_FALSE(hand_calculated(config).converged());
  config.converged_ln_std = 0.03;
  config.lock_out_frames = 2;
  config.lock_out_ln_std = 0.5;
  PlaneFilter filter = hand_calculated(config);
  EXPECT_TRUE(filter.converged());
  filter.end_frame(false, true);
  EXPECT_NEAR(filter.ln_height_std(), 0.02, 1e-12);
  filter.end_frame(false, true);
  EXPECT_NEAR(filter.cov()(2, 2), 4e-4 + 0.25, 1e-12);
}

TEST(PlaneFilterSettings, LevelRollHoldsAsTightlyAsConfigured) {
  FilterConfig config;
  config.level_roll_std_rad = 0.01;
  PlaneFilter filter = hand_calculated(config);
  filter.fuse(filter.level_roll());
  EXPECT_NEAR(filter.cov()(0, 0), 0.5e-4, 1e-12);
}

}  // namespace
}  // namespace plumb
