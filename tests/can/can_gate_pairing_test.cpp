// How the two halves of a camera frame find each other.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/can/gate_fixture.hpp"

namespace plumb {
namespace {

using namespace test;  // NOLINT: the fixture and its samples

class GatePairing : public GateFixture {};

TEST_F(GatePairing, HalfAFrameWaitsForTheOtherHalfOnlySoLong) {
  gate_.on_ego_motion(make_ego(1), now_us_);
  tick(11);  // up to 100 ms old
  EXPECT_TRUE(frames_sent().empty());
  EXPECT_FALSE(gate_.idle());
  tick();
  EXPECT_EQ(frames_sent(), std::vector<int>{1});
  EXPECT_EQ(sink_.newest().ego_validity, kValid);
  EXPECT_TRUE(std::isnan(sink_.newest().plane_validity));
  expect_all_plane_values_absent(sink_.newest());
  EXPECT_EQ(gate_.counters().num_unpaired, 1);
}

TEST_F(GatePairing, AHalfThatComesTooLateStillJoinsItsFrame) {
  gate_.on_ground_plane(make_plane(1), now_us_);
  tick(13);
  ASSERT_TRUE(std::isnan(sink_.newest().ego_validity));
  gate_.on_ego_motion(make_ego(1), now_us_);
  EXPECT_FALSE(gate_.idle());
  sink_.sent.clear();
  tick();
  EXPECT_EQ(frames_sent("PLB_OdometryX"), std::vector<int>{1}) << "at once, as for a new frame";
  EXPECT_EQ(sink_.newest().ego_validity, kValid);
  EXPECT_EQ(sink_.newest().plane_validity, kValid);
  EXPECT_EQ(gate_.counters().num_frames, 1);
  EXPECT_EQ(gate_.counters().num_repeated, 0);
}

TEST_F(GatePairing, ALateHalfIsSentBeforeTheNextFrameTakesItsPlace) {
  gate_.on_ground_plane(make_plane(1), now_us_);
  tick(13);
  sink_.sent.clear();
  gate_.on_ego_motion(make_ego(1), now_us_);
  give(2);
  tick(2);
  EXPECT_EQ(frames_sent(), (std::vector<int>{1, 2}));
}

TEST_F(GatePairing, ALateHalfFindsItsFrameInTheQueue) {
  give(1);
  give(2);
  gate_.on_ground_plane(make_plane(3), now_us_);
  now_us_ += 150'000;
  tick();  // frame 1 is sent, frame 3 is closed behind frame 2
  gate_.on_ego_motion(make_ego(3), now_us_);
  gate_.on_ego_motion(make_ego(3), now_us_);
  tick(2);
  EXPECT_EQ(frames_sent(), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(gate_.counters().num_repeated, 1);
}

TEST_F(GatePairing, TheNextFrameReleasesHalfAFrame) {
  gate_.on_ground_plane(make_plane(1), now_us_);
  give(2);
  tick();
  EXPECT_EQ(sink_.newest().frame_counter, 1.0);
  EXPECT_EQ(sink_.newest().plane_validity, kValid);
  EXPECT_TRUE(std::isnan(sink_.newest().ego_validity));
  tick();
  EXPECT_EQ(sink_.newest().frame_counter, 2.0);
  EXPECT_EQ(sink_.newest().ego_validity, kValid);
}

TEST_F(GatePairing, HalvesPairInEitherOrder) {
  gate_.on_ego_motion(make_ego(1), now_us_);
  gate_.on_ground_plane(make_plane(1), now_us_);
  tick();
  EXPECT_EQ(sink_.newest().ego_validity, kValid);
  EXPECT_EQ(sink_.newest().plane_validity, kValid);
  EXPECT_EQ(gate_.counters().num_unpaired, 0);
}

TEST_F(GatePairing, AFrozenSourceIsIgnoredAndBecomesStale) {
  give(1);
  for (int i = 0; i < 40; ++i) {
    give(1);
    tick();
  }
  EXPECT_EQ(gate_.counters().num_frames, 1);
  EXPECT_EQ(gate_.counters().num_repeated, 80);
  EXPECT_TRUE(std::isnan(sink_.newest().ego_validity));
}

TEST_F(GatePairing, TheSameHalfTwiceIsCountedAndTheFirstOneKept) {
  gate_.on_ground_plane(make_plane(1), now_us_);
  gate_.on_ground_plane(make_plane(1, CanPlaneStatus::kInvalid), now_us_);
  gate_.on_ego_motion(make_ego(1), now_us_);
  tick();
  EXPECT_EQ(gate_.counters().num_repeated, 1);
  EXPECT_EQ(sink_.newest().plane_validity, kValid);
  gate_.on_ego_motion(make_ego(2), now_us_);
  gate_.on_ego_motion(make_ego(2, CanEgoStatus::kLost), now_us_);
  EXPECT_EQ(gate_.counters().num_repeated, 2);
}

TEST_F(GatePairing, MissingFramesAreCountedAndShown) {
  give(10);
  give(11);
  give(15);
  tick(20);
  EXPECT_EQ(gate_.counters().num_missed, 3);
  EXPECT_EQ(sink_.newest().num_missed, 3.0);
}

TEST_F(GatePairing, ARestartedSourceIsTakenUpAgain) {
  give(1000);
  give(0);
  tick(2);
  EXPECT_EQ(frames_sent(), (std::vector<int>{1000 % 256, 0}));
  EXPECT_EQ(gate_.counters().num_missed, 0);
}

TEST_F(GatePairing, WildSequenceNumbersDoNoHarm) {
  for (const std::int64_t seq :
       {std::int64_t{0}, INT64_MAX, std::int64_t{1}, INT64_MAX - 1, INT64_MIN}) {
    give(seq);
    tick();
  }
  EXPECT_EQ(gate_.counters().num_frames, 5);
}

}  // namespace
}  // namespace plumb
