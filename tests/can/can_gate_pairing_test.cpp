// Tests how the two halves of a camera frame find each other.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/can/gate_fixture.hpp"

namespace plumb {
namespace {

using namespace test;  // NOLINT: the fixture and its samples

class GatePairing : public GateFixture {};

TEST_F(GatePairing, HalfAFrameWaitsForTheOtherHalfOnlySoLong) {
  hear(make_ego(1));
  tick(11);  // up to 100 ms old
  EXPECT_TRUE(frames_sent().empty());
  EXPECT_FALSE(gate_.idle());
  tick();
  EXPECT_EQ(frames_sent(), std::vector<int>{1});
  EXPECT_EQ(sink_.newest()["EgoMotion_Validity"], kValid);
  EXPECT_TRUE(std::isnan(sink_.newest()["GroundPlane_Validity"]));
  expect_all_plane_values_absent(sink_.newest());
  EXPECT_EQ(gate_.counters().num_unpaired, 1);
}

TEST_F(GatePairing, AHalfThatComesTooLateStillJoinsItsFrame) {
  hear(make_plane(1));
  tick(13);
  ASSERT_TRUE(std::isnan(sink_.newest()["EgoMotion_Validity"]));
  hear(make_ego(1));
  EXPECT_FALSE(gate_.idle());
  sink_.sent.clear();
  tick();
  EXPECT_EQ(frames_sent("OdometryX"), std::vector<int>{1}) << "at once, as for a new frame";
  EXPECT_EQ(sink_.newest()["EgoMotion_Validity"], kValid);
  EXPECT_EQ(sink_.newest()["GroundPlane_Validity"], kValid);
  EXPECT_EQ(gate_.counters().num_frames, 1);
  EXPECT_EQ(gate_.counters().num_repeated, 0);
}

TEST_F(GatePairing, ALateHalfIsSentBeforeTheNextFrameTakesItsPlace) {
  hear(make_plane(1));
  tick(13);
  sink_.sent.clear();
  hear(make_ego(1));
  give(2);
  tick(2);
  EXPECT_EQ(frames_sent(), (std::vector<int>{1, 2}));
}

TEST_F(GatePairing, ALateHalfFindsItsFrameInTheQueue) {
  give(1);
  give(2);
  hear(make_plane(3));
  now_us_ += 150'000;
  tick();  // frame 1 is sent; frame 3 is closed behind frame 2
  hear(make_ego(3));
  hear(make_ego(3));
  tick(2);
  EXPECT_EQ(frames_sent(), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(gate_.counters().num_repeated, 1);
}

TEST_F(GatePairing, TheNextFrameReleasesHalfAFrame) {
  hear(make_plane(1));
  give(2);
  tick();
  EXPECT_EQ(sink_.newest().frame_counter(), 1.0);
  EXPECT_EQ(sink_.newest()["GroundPlane_Validity"], kValid);
  EXPECT_TRUE(std::isnan(sink_.newest()["EgoMotion_Validity"]));
  tick();
  EXPECT_EQ(sink_.newest().frame_counter(), 2.0);
  EXPECT_EQ(sink_.newest()["EgoMotion_Validity"], kValid);
}

TEST_F(GatePairing, HalvesPairInEitherOrder) {
  hear(make_ego(1));
  hear(make_plane(1));
  tick();
  EXPECT_EQ(sink_.newest()["EgoMotion_Validity"], kValid);
  EXPECT_EQ(sink_.newest()["GroundPlane_Validity"], kValid);
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
  EXPECT_TRUE(std::isnan(sink_.newest()["EgoMotion_Validity"]));
}

TEST_F(GatePairing, TheSameHalfTwiceIsCountedAndTheFirstOneKept) {
  hear(make_plane(1));
  hear(make_plane(1, ground_plane_t::STATUS_INVALID));
  hear(make_ego(1));
  tick();
  EXPECT_EQ(gate_.counters().num_repeated, 1);
  EXPECT_EQ(sink_.newest()["GroundPlane_Validity"], kValid);
  hear(make_ego(2));
  hear(make_ego(2, ego_motion_t::STATUS_LOST));
  EXPECT_EQ(gate_.counters().num_repeated, 2);
}

TEST_F(GatePairing, MissingFramesAreCountedAndShown) {
  give(10);
  give(11);
  give(15);
  tick(20);
  EXPECT_EQ(gate_.counters().num_missed, 3);
  EXPECT_EQ(sink_.newest()["Status_NumMissed"], 3.0);
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
    CanSample ego = sample_of(make_ego(0));
    CanSample plane = sample_of(make_plane(0));
    ego.seq = plane.seq = seq;
    gate_.on_ground_plane(plane, now_us_);
    gate_.on_ego_motion(ego, now_us_);
    tick();
  }
  EXPECT_EQ(gate_.counters().num_frames, 5);
}

}  // namespace
}  // namespace plumb
