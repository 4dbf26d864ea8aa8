#include "modules/vo/motion_predictor.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb::vo {
namespace {

VoConfig config() {
  VoConfig c;
  c.coast_limit_s = 0.5;
  c.coast_decay_s = 1.0;
  return c;
}

const Se3 kStep{exp_so3({0.0, 0.02, 0.0}), {0.1, 0.0, 1.0}};

TEST(MotionPredictor, RepeatsTheLastMotionOverAnyInterval) {
  MotionPredictor motion(config());
  EXPECT_FALSE(motion.known());
  EXPECT_TRUE(motion.predict(0.1).t.isZero());
  motion.observe(kStep, 0.1);
  EXPECT_LT((motion.predict(0.1).t - kStep.t).norm(), 1e-12);
  EXPECT_LT((motion.predict(0.1).R - kStep.R).norm(), 1e-12);
  EXPECT_LT((motion.predict(0.2).t - 2.0 * kStep.t).norm(), 1e-12);
  EXPECT_NEAR(motion.measured_speed(), kStep.t.norm() / 0.1, 1e-12);
}

TEST(MotionPredictor, CoastingShrinksTheMotionAndTurnsFaster) {
  MotionPredictor motion(config());
  motion.observe(kStep, 0.1);
  const PredictedMotion first = motion.coast(0.1);
  ASSERT_TRUE(first.valid);
  EXPECT_LT((first.T_prev_cam.t - kStep.t).norm(), 1e-12) << "the first one has not faded";
  const PredictedMotion second = motion.coast(0.1);
  EXPECT_NEAR(second.T_prev_cam.t.norm() / kStep.t.norm(), std::exp(-0.1), 1e-12);
  EXPECT_NEAR(log_so3(second.T_prev_cam.R).norm() / log_so3(kStep.R).norm(), std::exp(-0.2), 1e-9);
  EXPECT_NEAR(motion.measured_speed(), kStep.t.norm() / 0.1, 1e-12) << "what was measured stays";
}

TEST(MotionPredictor, ExtrapolationKeepsTheMotion) {
  MotionPredictor motion(config());
  motion.observe(kStep, 0.1);
  (void)motion.extrapolate(0.1);
  const PredictedMotion second = motion.extrapolate(0.1);
  ASSERT_TRUE(second.valid);
  EXPECT_LT((second.T_prev_cam.t - kStep.t).norm(), 1e-12);
}

TEST(MotionPredictor, TheCovarianceGrowsWhileNothingIsSeen) {
  MotionPredictor motion(config());
  motion.observe(kStep, 0.1);
  const double first = motion.extrapolate(0.1).cov(2, 2);
  const double second = motion.extrapolate(0.1).cov(2, 2);
  EXPECT_GT(first, 0.0);
  EXPECT_GT(second, first);
}

TEST(MotionPredictor, IsValidUntilTheLimitAndAgainAfterTheNextMotion) {
  MotionPredictor motion(config());
  motion.observe(kStep, 0.1);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(motion.coast(0.099).valid, true) << i;
  EXPECT_FALSE(motion.coast(0.1).valid);
  EXPECT_TRUE(motion.coast(0.1).T_prev_cam.t.isZero());
  motion.observe(kStep, 0.1);
  EXPECT_EQ(motion.unseen_s(), 0.0);
  EXPECT_TRUE(motion.coast(0.1).valid);
}

TEST(MotionPredictor, WithoutAMotionNothingIsPredicted) {
  MotionPredictor motion(config());
  EXPECT_FALSE(motion.coast(0.1).valid);
  EXPECT_EQ(motion.measured_speed(), 0.0);
}

}  // namespace
}  // namespace plumb::vo
