/// Tests what the road's speed makes of the heights of the other cues.
#include "modules/ground/motion_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

constexpr double kInterval_s = 0.04;

/// What the cues say of the height when the road's speed says 1 +- `motion_std`.
Observations heights(double motion_std, double dense, double points) {
  Observations observations;
  const auto say = [&](CueId cue, double height, double std) {
    observations[cue].report.status = CueStatus::kUsed;
    observations[cue].report.height = height;
    observations[cue].report.height_var = square(std * height);
  };
  say(kCueMotion, 1.0, motion_std);
  say(kCueDense, dense, 0.01);
  say(kCuePoints, points, 0.01);
  return observations;
}

CueStatus dense_after(MotionJudge* judge, double dense) {
  Observations observations = heights(0.05, dense, 1.0);
  (void)judge->judge(kInterval_s, &observations);
  return observations[kCueDense].report.status;
}

TEST(MotionJudge, RefusesASingleHeightThatContradictsTheRoadsSpeed) {
  MotionJudge judge;
  Observations observations = heights(0.05, 1.2, 1.05);
  EXPECT_FALSE(judge.judge(kInterval_s, &observations)) << "one height is no reason to doubt more";
  EXPECT_EQ(observations[kCueDense].report.status, CueStatus::kFailed);
  EXPECT_EQ(observations[kCuePoints].report.status, CueStatus::kUsed);
  EXPECT_EQ(observations[kCueMotion].report.status, CueStatus::kUsed);
}

TEST(MotionJudge, ASpeedThatIsPoorlyKnownRefusesNothingForItsDistance) {
  MotionJudge judge;
  for (int i = 0; i < 100; ++i) {
    Observations observations = heights(0.09, 1.4, 1.05);
    EXPECT_FALSE(judge.judge(kInterval_s, &observations));
    EXPECT_EQ(observations[kCueDense].report.status, CueStatus::kUsed);
  }
}

TEST(MotionJudge, RefusesACueWhoseHeightsScatterAndSaysSoOnce) {
  MotionJudge judge;
  int num_said = 0;
  for (int i = 0; i < 75; ++i) {  // 3 s
    Observations observations = heights(0.05, i % 2 == 0 ? 0.9 : 1.02, 1.04);
    num_said += judge.judge(kInterval_s, &observations) ? 1 : 0;
    EXPECT_EQ(observations[kCuePoints].report.status, CueStatus::kUsed);
  }
  EXPECT_EQ(num_said, 1);
  EXPECT_EQ(dense_after(&judge, 0.96), CueStatus::kFailed) << "one good height is not enough";
}

TEST(MotionJudge, ARoadThatIsNewlySeenShowsScatterAlready) {
  MotionJudge judge;
  bool is_refused = false;
  for (int i = 0; i < 30; ++i) {
    Observations observations = heights(0.2, i % 2 == 0 ? 0.9 : 1.02, 1.04);
    (void)judge.judge(kInterval_s, &observations);
    is_refused = observations[kCueDense].report.status == CueStatus::kFailed;
    EXPECT_EQ(observations[kCuePoints].report.status, CueStatus::kUsed);
  }
  EXPECT_TRUE(is_refused);
}

TEST(MotionJudge, TakesACueBackThatKeepsToItsDeviation) {
  MotionJudge judge;
  for (int i = 0; i < 75; ++i) (void)dense_after(&judge, i % 2 == 0 ? 0.9 : 1.02);
  for (int i = 0; i < 150; ++i) (void)dense_after(&judge, i % 2 == 0 ? 0.99 : 1.01);
  EXPECT_EQ(dense_after(&judge, 1.0), CueStatus::kUsed);
}

TEST(MotionJudge, ASteadyCueIsBelievedFartherFromTheRoadsSpeed) {
  MotionJudge judge;
  EXPECT_EQ(dense_after(&judge, 0.85), CueStatus::kFailed) << "nothing is known of it yet";
  for (int i = 0; i < 20; ++i) (void)dense_after(&judge, i % 2 == 0 ? 0.845 : 0.855);
  EXPECT_EQ(dense_after(&judge, 0.85), CueStatus::kUsed) << "the pitch may be wrong";
  EXPECT_EQ(dense_after(&judge, 0.75), CueStatus::kFailed);
}

TEST(MotionJudge, OneWildHeightRefusesNoOtherOne) {
  MotionJudge judge;
  for (int i = 0; i < 75; ++i) EXPECT_EQ(dense_after(&judge, 1.03), CueStatus::kUsed);
  EXPECT_EQ(dense_after(&judge, 3.0), CueStatus::kFailed);
  EXPECT_EQ(dense_after(&judge, 1.03), CueStatus::kUsed);
}

TEST(MotionJudge, JudgesAlikeAtAnyRateOfImages) {
  const auto refused_after_s = [](double interval_s) {
    MotionJudge judge;
    double time_s = 0.0;
    bool refused = false;
    for (int i = 0; !refused && time_s < 10.0; ++i) {
      Observations observations = heights(0.05, i % 2 == 0 ? 0.95 : 1.03, 1.0);
      refused = judge.judge(interval_s, &observations);
      time_s += interval_s;
    }
    return time_s;
  };
  EXPECT_LT(refused_after_s(0.1), 5.0);
  EXPECT_NEAR(refused_after_s(0.1), refused_after_s(0.03), 0.3);
}

TEST(MotionJudge, TheGapToTheFilterCountsBeyondTheUsualOne) {
  MotionJudge judge;
  Observation motion = heights(0.06, 1.0, 1.0)[kCueMotion];
  for (int i = 0; i < 20; ++i) judge.follow_filter(motion, 0.02);
  EXPECT_EQ(judge.excess(), 0.0);
  for (int i = 0; i < 20; ++i) judge.follow_filter(motion, 0.10);
  EXPECT_NEAR(judge.excess(), 0.06, 1e-3);
  motion.report.status = CueStatus::kAbsent;
  for (int i = 0; i < 20; ++i) judge.follow_filter(motion, 0.10);
  EXPECT_EQ(judge.excess(), 0.0) << "without the road's speed";
}

}  // namespace
}  // namespace plumb
