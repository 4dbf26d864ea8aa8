#include "tools/evaluate/eval/plane_metric.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb {
namespace {

std::map<std::int64_t, TruePlane> level_road(int num_frames) {
  std::map<std::int64_t, TruePlane> planes;
  for (int i = 0; i < num_frames; ++i) planes[i] = TruePlane{Eigen::Vector3d::UnitY(), 1.5};
  return planes;
}

EstimatedPlane estimate(std::int64_t seq, double height_m, double pitch_rad) {
  EstimatedPlane plane;
  plane.seq = seq;
  plane.status = "ok";
  plane.height_m = height_m;
  plane.pitch_rad = pitch_rad;
  plane.roll_rad = 0.0;
  return plane;
}

TEST(PlaneMetric, AgreesWithAHandComputation) {
  // 1.65 is 10 % too high, 1.47 is 2 % too low, 1.5 is right.
  const PlaneReport report = compare_planes(
      level_road(4), {estimate(0, 1.65, 0.01), estimate(1, 1.47, -0.01), estimate(2, 1.5, 0.03)});
  EXPECT_EQ(report.num_true, 4);
  EXPECT_EQ(report.num_compared, 3);
  EXPECT_NEAR(report.height_error_mean_percent, 4.0, 1e-9);
  EXPECT_NEAR(report.height_error_median_percent, 2.0, 1e-9);
  EXPECT_NEAR(report.height_error_max_percent, 10.0, 1e-9);
  EXPECT_NEAR(report.height_bias_percent, 8.0 / 3.0, 1e-9);
  EXPECT_NEAR(report.within_7_ratio, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(report.pitch.mean_rad, 0.01, 1e-12);
  EXPECT_NEAR(report.pitch.std_rad, 0.02, 1e-12);
  EXPECT_NEAR(report.pitch.rms_rad, std::sqrt(0.0011 / 3.0), 1e-12);
}

TEST(PlaneMetric, PassesOverFramesWithoutTruthOrEstimate) {
  EstimatedPlane nothing;
  nothing.seq = 1;
  nothing.status = "initializing";
  const PlaneReport report =
      compare_planes(level_road(3), {estimate(99, 9.0, 0.0), nothing, estimate(2, 1.5, 0.0)});
  EXPECT_EQ(report.num_compared, 1);
  EXPECT_EQ(report.num_ok, 1);
  EXPECT_NEAR(report.height_error_mean_percent, 0.0, 1e-12);
}

TEST(PlaneMetric, CountsHeldPlanesApart) {
  EstimatedPlane held = estimate(1, 1.5, 0.0);
  held.status = "held";
  const PlaneReport report = compare_planes(level_road(2), {estimate(0, 1.5, 0.0), held});
  EXPECT_EQ(report.num_compared, 2);
  EXPECT_EQ(report.num_ok, 1);
}

TEST(PlaneMetric, HoldsErrorsAgainstStatedDeviations) {
  EstimatedPlane right = estimate(0, 1.6, 0.02);  // off by 0.1 m and 20 mrad
  right.height_std_m = 0.1;
  right.pitch_std_rad = 0.01;
  EstimatedPlane wrong = estimate(1, 1.8, 0.0);  // off by 0.3 m
  wrong.height_std_m = 0.1;
  const PlaneReport report = compare_planes(level_road(2), {right, wrong});
  EXPECT_EQ(report.height_calibration.num, 2);
  EXPECT_NEAR(report.height_calibration.nees, (1.0 + 9.0) / 2.0, 1e-9);
  EXPECT_NEAR(report.height_calibration.within_2_sigma, 0.5, 1e-12);
  EXPECT_EQ(report.pitch_calibration.num, 1);
  EXPECT_NEAR(report.pitch_calibration.nees, 4.0, 1e-9);
  EXPECT_EQ(report.roll_calibration.num, 0);
  EXPECT_TRUE(std::isnan(report.roll_calibration.nees));
}

}  // namespace
}  // namespace plumb
