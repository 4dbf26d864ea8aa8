#include "tools/evaluate/eval/scale_ratio.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/drives.hpp"

namespace plumb {
namespace {

using test::drive_step;
using test::repeat;

TEST(ScaleRatio, FindsAConstantFactorOnACurve) {
  const ScaleRatio ratio =
      scale_ratio(repeat(drive_step(1.0, 0.02), 61), repeat(drive_step(1.05, 0.02), 61), 10.0);
  EXPECT_EQ(ratio.steps.num, 60);
  EXPECT_NEAR(ratio.steps.median, 1.05, 1e-9);
  EXPECT_NEAR(ratio.steps.spread, 0.0, 1e-9);
  EXPECT_EQ(ratio.windows.num, 5);  // 11 steps each
  EXPECT_NEAR(ratio.windows.median, 1.05, 1e-9);
}

TEST(ScaleRatio, LeavesOutStepsThatTruthCannotResolve) {
  const auto slow = repeat(drive_step(0.2), 20);
  const ScaleRatio ratio = scale_ratio(slow, slow, 10.0);
  EXPECT_EQ(ratio.steps.num, 0);
  EXPECT_EQ(ratio.windows.num, 0);
  EXPECT_TRUE(std::isnan(ratio.windows.median));
}

TEST(ScaleRatio, WindowsAreDeafToStepsThatJitter) {
  // WHEN true steps alternate between 1.1 and 0.9 m and the estimate is even:
  std::vector<PoseMatrix> gt;
  Se3 T_world_cam;
  for (int i = 0; i < 101; ++i) {
    gt.push_back(test::to_matrix(T_world_cam));
    T_world_cam = T_world_cam * drive_step(i % 2 == 0 ? 1.1 : 0.9);
  }
  const ScaleRatio ratio = scale_ratio(gt, repeat(drive_step(1.0), 101), 20.0);
  EXPECT_GT(ratio.steps.spread, 0.1);
  EXPECT_LT(ratio.windows.spread, 0.01);
  EXPECT_NEAR(ratio.windows.median, 1.0, 0.01);
}

}  // namespace
}  // namespace plumb
