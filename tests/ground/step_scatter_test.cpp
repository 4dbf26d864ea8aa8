#include "modules/ground/ego/step_scatter.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

constexpr double kStatedVar = 0.01;

double after(StepScatter* scatter, double difference_m_s, int num_images) {
  double factor = 0.0;
  for (int k = 0; k < num_images; ++k) {
    const double sign = k % 2 == 0 ? 1.0 : -1.0;
    factor = scatter->factor(sign * difference_m_s, 0.0, kStatedVar, 0.1);
  }
  return factor;
}

TEST(StepScatter, FollowsTheScatterOfTheDrive) {
  StepScatter scatter;
  EXPECT_NEAR(after(&scatter, 0.2, 100), 4.0, 0.1);
  EXPECT_NEAR(after(&scatter, 0.1, 200), 1.0, 0.1);
}

TEST(StepScatter, NeverStatesNextToNothing) {
  StepScatter scatter;
  EXPECT_DOUBLE_EQ(after(&scatter, 0.0, 200), 0.25);
}

TEST(StepScatter, OneStepThatLeavesTheOthersHasAnErrorOfItsOwn) {
  StepScatter scatter;
  (void)after(&scatter, 0.1, 100);
  const double factor = scatter.factor(0.6, 0.0, kStatedVar, 0.1);
  EXPECT_NEAR(factor * kStatedVar, 0.3 * 0.3, 1e-9);
  EXPECT_LT(scatter.factor(0.1, 0.0, kStatedVar, 0.1), 2.0) << "and the next does not";
}

}  // namespace
}  // namespace plumb
