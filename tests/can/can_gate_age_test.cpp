// Tests that the gate counts ages from the capture of the image, at every tick.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/can/gate_fixture.hpp"

namespace plumb {
namespace {

using namespace test;  // NOLINT: the fixture and its samples

class GateAge : public GateFixture {
 protected:
  void give_captured(std::int64_t seq, std::int64_t capture_us) {
    CanSample plane = sample_of(make_plane(seq));
    CanSample ego = sample_of(make_ego(seq));
    plane.capture_mono_us = ego.capture_mono_us = capture_us;
    gate_.on_ground_plane(plane, now_us_);
    gate_.on_ego_motion(ego, now_us_);
  }
  [[nodiscard]] double mode() const { return sink_.newest()["Status_Mode"]; }
};

TEST_F(GateAge, CountsFromTheCaptureNotFromTheReceipt) {
  give_captured(1, now_us_ - 240'000);
  tick(2);
  EXPECT_EQ(sink_.newest()["EgoMotion_Validity"], kValid) << "250 ms old";
  EXPECT_EQ(sink_.newest()["GroundPlane_Validity"], kValid);
  tick();
  EXPECT_TRUE(std::isnan(sink_.all("EgoMotion").back()["EgoMotion_Validity"]));
  EXPECT_TRUE(std::isnan(sink_.all("GroundPlane").back()["GroundPlane_Validity"]));
  EXPECT_EQ(gate_.counters().num_late, 0);
}

TEST_F(GateAge, WhatIsTooOldOnReceiptIsNeverSentAndIsCounted) {
  give_captured(1, now_us_ - 250'001);
  tick(10);
  for (const Reading& v : sink_.all("EgoMotion")) {
    EXPECT_TRUE(std::isnan(v["EgoMotion_Validity"]));
    EXPECT_EQ(v.frame_counter(), 1.0);
  }
  expect_all_ego_values_absent(sink_.newest());
  expect_all_plane_values_absent(sink_.newest());
  EXPECT_EQ(gate_.counters().num_late, 2);
}

TEST_F(GateAge, IsASignalThatGrowsWithEveryTransmission) {
  tick();
  EXPECT_TRUE(std::isnan(sink_.newest()["Frame_Age"])) << "no frame yet";
  give_captured(1, now_us_ - 80'000);
  tick(2);
  EXPECT_NEAR(sink_.newest()["Frame_Age"], 0.08, 0.0006);
  tick();
  EXPECT_NEAR(sink_.newest()["Frame_Age"], 0.1, 0.0006);
  tick(100);
  EXPECT_NEAR(sink_.newest()["Frame_Age"], 1.1, 0.0006) << "also of a frame that is too old";
  tick(400);
  EXPECT_TRUE(std::isnan(sink_.newest()["Frame_Age"])) << "beyond the range of the signal";
}

TEST_F(GateAge, AnUnknownCaptureTimeIsNotAvailable) {
  give_captured(1, 0);
  tick(10);
  EXPECT_TRUE(std::isnan(sink_.newest()["EgoMotion_Validity"]));
  EXPECT_TRUE(std::isnan(sink_.newest()["Frame_Age"]));
  EXPECT_EQ(gate_.counters().num_late, 0) << "it is not known to be late";
}

TEST_F(GateAge, ACaptureTimeAheadIsUnknownUnlessItIsWithinTheTolerance) {
  give_captured(1, now_us_ + 20'000);
  tick();
  EXPECT_EQ(sink_.newest()["EgoMotion_Validity"], kValid);
  EXPECT_EQ(sink_.newest()["Frame_Age"], 0.0);
  give_captured(2, now_us_ + 20'001);
  gate_.tick(now_us_, sink_);
  EXPECT_TRUE(std::isnan(sink_.newest()["EgoMotion_Validity"]));
  for (const std::int64_t capture_us : {INT64_MAX, INT64_MIN, std::int64_t{-1}}) {
    give_captured(3 + (capture_us & 1), capture_us);
    tick();
    EXPECT_TRUE(std::isnan(sink_.newest()["EgoMotion_Validity"])) << capture_us;
  }
}

TEST_F(GateAge, EachHalfHasItsOwn) {
  CanSample plane = sample_of(make_plane(1));
  CanSample ego = sample_of(make_ego(1));
  plane.capture_mono_us = now_us_;
  ego.capture_mono_us = now_us_ - 1'000'000;
  gate_.on_ground_plane(plane, now_us_);
  gate_.on_ego_motion(ego, now_us_);
  tick();
  EXPECT_TRUE(std::isnan(sink_.newest()["EgoMotion_Validity"]));
  EXPECT_EQ(sink_.newest()["GroundPlane_Validity"], kValid);
}

TEST_F(GateAge, TheModeSaysWhyNothingIsSent) {
  tick(10);
  EXPECT_EQ(mode(), static_cast<double>(CanMode::kNoInput));
  give_captured(1, now_us_ - 1'000'000);
  tick(10);
  EXPECT_EQ(mode(), static_cast<double>(CanMode::kTooOld));
  give_captured(2, 0);
  tick(10);
  EXPECT_EQ(mode(), static_cast<double>(CanMode::kAgeUnknown));
  tick(30);
  EXPECT_EQ(mode(), static_cast<double>(CanMode::kNoInput)) << "nothing came for 0.25 s";
}

TEST_F(GateAge, PassesOverFramesThatBecameTooOldWhileTheyWaited) {
  for (int seq = 1; seq <= 5; ++seq) give(seq);
  now_us_ += 1'000'000;  // no tick for a second
  give(6);
  tick();
  EXPECT_EQ(frames_sent(), std::vector<int>{6}) << "at once";
  EXPECT_EQ(gate_.counters().num_passed, 5);
  EXPECT_TRUE(gate_.idle());
}

TEST_F(GateAge, ANewSessionWithTheSameNumberIsAnotherFrame) {
  give(5);
  CanSample plane = sample_of(make_plane(5));
  CanSample ego = sample_of(make_ego(5));
  plane.session = ego.session = 2;
  plane.capture_mono_us = ego.capture_mono_us = now_us_;
  gate_.on_ground_plane(plane, now_us_);
  gate_.on_ego_motion(ego, now_us_);
  tick(2);
  EXPECT_EQ(gate_.counters().num_frames, 2);
  EXPECT_EQ(gate_.counters().num_repeated, 0);
  plane.seq = ego.seq = 50'000;
  plane.session = ego.session = 3;
  gate_.on_ground_plane(plane, now_us_);
  gate_.on_ego_motion(ego, now_us_);
  EXPECT_EQ(gate_.counters().num_missed, 0) << "its numbers do not continue the earlier ones";
}

}  // namespace
}  // namespace plumb
