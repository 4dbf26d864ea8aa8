#include "modules/ground/filter/scale_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb {
namespace {

double held_std(ScaleDrift* drift, int num_images) {
  double var = 0.0;
  for (int k = 0; k < num_images; ++k) var += drift->held(0.1);
  return std::sqrt(var);
}

TEST(ScaleDrift, GrowsInProportionToTheTimeAtTheRateOfTheSetting) {
  FilterConfig config;
  config.held_drift_per_s = 0.02;
  ScaleDrift drift(config);
  EXPECT_NEAR(held_std(&drift, 30), 0.06, 1e-9);
}

TEST(ScaleDrift, LearnsTheRateOfADriftingDrive) {
  ScaleDrift drift;
  // VO's unit falls by 5 % per second, and the filter follows.
  for (int k = 0; k < 400; ++k) drift.measured(-0.005 * k, 1e-4, 0.1);
  EXPECT_NEAR(drift.rate_per_s(), 0.05, 0.01);
  EXPECT_NEAR(held_std(&drift, 40), 0.2, 0.04);
}

TEST(ScaleDrift, TakesErrorsOfTheHeightForNoDrift) {
  ScaleDrift drift;
  for (int k = 0; k < 400; ++k) drift.measured(k % 40 < 20 ? 0.0 : 0.01, 1e-4, 0.1);
  EXPECT_LT(drift.rate_per_s(), FilterConfig{}.held_drift_per_s);
}

TEST(ScaleDrift, BeginsAnewWithEveryMeasurement) {
  ScaleDrift drift;
  const double first = held_std(&drift, 20);
  drift.measured(0.0, 1e-4, 0.1);
  EXPECT_DOUBLE_EQ(held_std(&drift, 20), first);
}

TEST(ScaleDrift, ANewUnitIsNoDrift) {
  ScaleDrift drift;
  for (int k = 0; k < 200; ++k) {
    if (k % 50 == 0) drift.change_unit();
    drift.measured(k / 50, 1e-4, 0.1);
  }
  EXPECT_LT(drift.rate_per_s(), FilterConfig{}.held_drift_per_s);
}

}  // namespace
}  // namespace plumb
