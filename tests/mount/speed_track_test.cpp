#include "modules/mount/speed_track.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

TEST(SpeedTrack, AddsUpTheWayBetweenTwoTimes) {
  SpeedTrack track;
  EXPECT_EQ(track.take({1'000'000, 10.0, 0.0}), nullptr);
  EXPECT_EQ(track.take({1'100'000, 12.0, 0.0}), nullptr);
  EXPECT_EQ(track.take({1'200'000, 12.0, 0.0}), nullptr);
  EXPECT_NEAR(*track.way_m(1'000'000, 1'100'000), 1.1, 1e-12);
  EXPECT_NEAR(*track.way_m(1'050'000, 1'150'000), 0.05 * 11.5 + 0.05 * 12.0, 1e-12)
      << "linear between the speeds";
  EXPECT_FALSE(track.way_m(999'999, 1'100'000)) << "begins before the first speed";
  EXPECT_FALSE(track.way_m(1'100'000, 1'200'001)) << "ends after the last one";
  EXPECT_TRUE(track.reaches(1'200'000));
  EXPECT_FALSE(track.reaches(1'200'001));
}

TEST(SpeedTrack, KnowsNoWayOverAGap) {
  SpeedTrack track;
  for (const std::int64_t ms : {0, 100, 360, 460})
    EXPECT_EQ(track.take({1000 * ms, 10.0, 0.0}), nullptr);
  EXPECT_TRUE(track.way_m(0, 100'000));
  EXPECT_FALSE(track.way_m(50'000, 150'000));
  EXPECT_TRUE(track.way_m(360'000, 460'000)) << "known again after it";
}

TEST(SpeedTrack, RefusesWhatComesOutOfOrderAndBeginsAnewAfterAJumpBack) {
  SpeedTrack track;
  EXPECT_EQ(track.take({5'000'000, 10.0, 0.0}), nullptr);
  EXPECT_STREQ(track.take({5'000'000, 10.0, 0.0}), "vehicle speed came twice or out of order");
  EXPECT_STREQ(track.take({4'000'000, 10.0, 0.0}), "vehicle speed came twice or out of order");
  EXPECT_EQ(track.take({3'999'999, 10.0, 0.0}), nullptr);
  EXPECT_FALSE(track.reaches(5'000'000));
}

TEST(SpeedTrack, ForgetsTheOldestSpeeds) {
  SpeedTrack track;
  const auto count = static_cast<std::int64_t>(SpeedTrack::kMostSamples) + 10;
  for (std::int64_t i = 0; i < count; ++i) EXPECT_EQ(track.take({10'000 * i, 5.0, 0.0}), nullptr);
  EXPECT_FALSE(track.way_m(0, 50'000));
  EXPECT_NEAR(*track.way_m(10'000 * (count - 3), 10'000 * (count - 1)), 0.1, 1e-12);
}

}  // namespace
}  // namespace plumb
