#include "platform/stage_timer.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace plumb {
namespace {

TEST(DurationHistogram, GivesQuantilesWithinTwoPercent) {
  DurationHistogram h;
  for (int i = 1; i <= 1000; ++i) h.add(i * 10.0);  // from 10 us to 10 ms
  EXPECT_EQ(1000, h.num_samples());
  EXPECT_NEAR(5000.0, h.quantile_us(0.5), 100.0);
  EXPECT_NEAR(9900.0, h.quantile_us(0.99), 198.0);
  EXPECT_NEAR(10.0, h.quantile_us(0.0), 0.2);
  EXPECT_EQ(10'000.0, h.max_us());
  EXPECT_LE(h.quantile_us(1.0), h.max_us());
}

TEST(DurationHistogram, HoldsEveryDurationHoweverSmallOrLarge) {
  DurationHistogram h;
  h.add(0.0);
  h.add(-1.0);  // the clock stepped back
  h.add(1e12);
  EXPECT_EQ(3, h.num_samples());
  EXPECT_EQ(1e12, h.max_us());
  EXPECT_LT(h.quantile_us(0.5), 1.0);
}

TEST(DurationHistogram, IsZeroWithoutSamples) {
  const DurationHistogram h;
  EXPECT_EQ(0.0, h.quantile_us(0.5));
  EXPECT_EQ(0.0, h.max_us());
}

TEST(StageTimer, SumsAStageThatRunsTwiceInAFrame) {
  StageTimer timer;
  for (int frame = 0; frame < 3; ++frame) {
    timer.begin();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    timer.mark("track");
    timer.mark("solve");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    timer.mark("track");
    timer.end();
  }
  ASSERT_EQ(3U, timer.num_stages()) << "the stages are track, solve and total";
  EXPECT_STREQ("track", timer.stats(0).name);
  EXPECT_STREQ("solve", timer.stats(1).name);
  EXPECT_STREQ("total", timer.stats(2).name);
  EXPECT_EQ(3, timer.stats(0).num_samples);
  EXPECT_GE(timer.stats(0).last_us, 4000.0);
  EXPECT_LT(timer.stats(1).last_us, 2000.0);
  EXPECT_NEAR(timer.stats(0).last_us + timer.stats(1).last_us, timer.total().last_us, 1e-6);
}

TEST(StageTimer, TellsStagesApartByTextNotByAddress) {
  StageTimer timer;
  const std::string copy("track");
  timer.begin();
  timer.mark("track");
  timer.mark(copy.c_str());
  timer.end();
  EXPECT_EQ(2U, timer.num_stages());
}

TEST(StageTimer, LeavesOutTheTimeBetweenFramesAndFramesGivenUp) {
  StageTimer timer;
  timer.mark("outside");  // no frame was begun
  timer.begin();          // this frame is abandoned
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  timer.begin();
  timer.mark("track");
  timer.end();
  timer.end();  // there is no frame to end
  ASSERT_EQ(2U, timer.num_stages());
  EXPECT_EQ(1, timer.total().num_samples);
  EXPECT_LT(timer.total().max_us, 15'000.0);
}

TEST(StageTimer, ShowsAStageThatDidNotRunInTheNewestFrameAsZero) {
  StageTimer timer;
  timer.begin();
  timer.mark("keyframe");
  timer.end();
  timer.begin();
  timer.mark("track");
  timer.end();
  EXPECT_EQ(0.0, timer.stats(0).last_us);
  EXPECT_EQ(1, timer.stats(0).num_samples);
}

TEST(StageTimer, CountsStagesThatDoNotFit) {
  StageTimer timer;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < StageTimer::kMaxStages + 2; ++i)
    names.push_back(std::string("s").append(std::to_string(i)));
  timer.begin();
  for (const std::string& name : names) timer.mark(name.c_str());
  timer.end();
  EXPECT_EQ(StageTimer::kMaxStages, timer.num_stages());
  EXPECT_EQ(3, timer.num_refused());
}

}  // namespace
}  // namespace plumb
