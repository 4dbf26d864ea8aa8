// Tests the whole way of a message to the bus: senders, limits of the vehicle, age, clock.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/numbers.hpp"
#include "modules/can/can_wire.hpp"
#include "plumb/vo_motion_t.hpp"
#include "tests/can/drive.hpp"
#include "tests/can/recording_sink.hpp"

namespace plumb {
namespace {

using namespace test;  // NOLINT: the drive, the sink and the default messages

TEST(CanOutputTest, ARejectedMessageIsCountedAndShown) {
  CanOutput output{CanConfig{}};
  RecordingSink sink;
  ego_motion_t bad_ego = Drive().ego();
  bad_ego.status = 9;
  ground_plane_t bad_plane = Drive().plane();
  bad_plane.status = 9;
  EXPECT_STREQ(output.on_ego_motion(bad_ego, 0), "unknown status");
  EXPECT_STREQ(output.on_ground_plane(bad_plane, 0), "unknown status");
  EXPECT_EQ(output.num_rejected(), 2);
  output.report(1, 5);
  output.tick(0, sink);
  EXPECT_EQ(sink.newest()["Status_NumRejected"], 3.0);
  EXPECT_EQ(sink.newest()["Status_NumUnsent"], 5.0);
  EXPECT_TRUE(std::isnan(sink.newest()["EgoMotion_Validity"]));
}

TEST(CanOutputTest, TwoCamerasShareOneBus) {
  CanConfig second;
  second.base_id = 0x3C0;
  second.base_data_id = 0x3C00;
  CanOutput front{CanConfig{}};
  CanOutput rear{second};
  RecordingSink bus;
  for (CanOutput* const output : {&front, &rear}) {
    ASSERT_EQ(output->on_ground_plane(Drive().plane(), 0), nullptr);
    ASSERT_EQ(output->on_ego_motion(Drive().ego(), 0), nullptr);
    for (int i = 0; i < 100; ++i) output->tick(i * CanGate::kTickUs, bus);
  }
  const Messages theirs = can_messages(second);
  std::size_t num_front = 0;
  for (const Sent& s : bus.sent) {
    int num_owners = 0;
    for (std::size_t i = 0; i < kNumMessages; ++i) {
      MessageValues values;
      const bool is_front = decode(default_messages()[i], s.frame, &values);
      num_front += is_front ? 1 : 0;
      num_owners += (is_front ? 1 : 0) + (decode(theirs[i], s.frame, &values) ? 1 : 0);
    }
    ASSERT_EQ(num_owners, 1) << s.frame.id;
  }
  EXPECT_EQ(2 * num_front, bus.sent.size());
}

/// A live drive through CanOutput: one image every 100 ms, ten ticks in between.
class LiveDrive : public ::testing::Test {
 protected:
  CanOutput output_{CanConfig{}};
  RecordingSink sink_;
  Drive drive_;
  std::int64_t delay_us_ = 30'000;  ///< from the capture to the receipt

  LiveDrive() { drive_.session = 77; }
  /// Returns what plumb-can says to EGO_MOTION.
  const char* hear(const ego_motion_t& ego, const ground_plane_t& plane) {
    const std::int64_t now_us = ego.utime + delay_us_;
    (void)output_.on_ground_plane(plane, now_us);
    return output_.on_ego_motion(ego, now_us);
  }
  void tick(int num_ticks = 10) {
    for (int i = 0; i < num_ticks; ++i)
      output_.tick(drive_.utime + delay_us_ + i * CanGate::kTickUs, sink_);
  }
  void drive(int num_images) {
    for (int i = 0; i < num_images; ++i) {
      drive_.step();
      ASSERT_EQ(hear(drive_.ego(), drive_.plane()), nullptr);
      tick();
    }
  }
  [[nodiscard]] double sent(const char* signal) const { return sink_.newest()[signal]; }
  [[nodiscard]] CanValidity validity(const char* signal) const {
    return static_cast<CanValidity>(sent(signal));
  }
  [[nodiscard]] PlausibilityReason doubt(const char* signal) const {
    return static_cast<PlausibilityReason>(sent(signal));
  }
};

TEST_F(LiveDrive, IsBelievedFromTheFourthImageOn) {
  drive(1);
  EXPECT_EQ(validity("EgoMotion_Validity"), CanValidity::kInvalid);
  EXPECT_EQ(doubt("Frame_SpeedDoubt"), PlausibilityReason::kInterval);
  EXPECT_EQ(validity("OdomX_Validity"), CanValidity::kDegraded);
  drive(2);
  EXPECT_EQ(validity("EgoMotion_Validity"), CanValidity::kInvalid);
  EXPECT_EQ(doubt("Frame_SpeedDoubt"), PlausibilityReason::kRecovering);
  drive(1);
  EXPECT_EQ(validity("EgoMotion_Validity"), CanValidity::kValid);
  EXPECT_EQ(validity("GroundPlane_Validity"), CanValidity::kValid);
  EXPECT_EQ(validity("OdomX_Validity"), CanValidity::kValid);
  EXPECT_EQ(sent("Status_Mode"), static_cast<double>(CanMode::kNormal));
  EXPECT_NEAR(sent("Frame_Age"), 0.11, 0.0006) << "the last tick on which it was due";
}

TEST_F(LiveDrive, ASpeedThatNoCarReachesIsNotAvailableAndSaysWhy) {
  drive(10);
  drive_.step();
  ego_motion_t ego = drive_.ego();
  ego.velocity_ground_m_s[0] = 57.2;
  ego.t_prev_cam_m[2] = 5.72;
  ASSERT_EQ(hear(ego, drive_.plane()), nullptr);
  tick();
  EXPECT_TRUE(std::isnan(sent("EgoMotion_Speed")));
  EXPECT_EQ(validity("EgoMotion_Validity"), CanValidity::kInvalid);
  EXPECT_EQ(validity("OdomX_Validity"), CanValidity::kInvalid) << "the step is not in the distance";
  EXPECT_EQ(doubt("Frame_SpeedDoubt"), PlausibilityReason::kTooFast);
  EXPECT_EQ(sent("Status_EgoReason"), vo_motion_t::REASON_IMPLAUSIBLE);
  EXPECT_EQ(validity("GroundPlane_Validity"), CanValidity::kValid);
  EXPECT_EQ(output_.motion_refusal(), PlausibilityReason::kTooFast);
  EXPECT_EQ(output_.num_rejected(), 0) << "the message keeps its contract";
  const std::int64_t num_refused = output_.num_implausible();
  drive(3);
  EXPECT_EQ(validity("EgoMotion_Validity"), CanValidity::kValid) << "three good images heal it";
  EXPECT_EQ(output_.num_implausible(), num_refused + 2);
}

TEST_F(LiveDrive, AnAccelerationOrHeightThatNoCarHasIsNotAvailable) {
  drive(5);
  drive_.step();
  ego_motion_t ego = drive_.ego();
  ego.accel_forward_m_s2 = 18.0;
  ground_plane_t plane = drive_.plane();
  plane.height_m = 3.9;
  ASSERT_EQ(hear(ego, plane), nullptr);
  tick();
  EXPECT_TRUE(std::isnan(sent("EgoDetail_AccelX")));
  EXPECT_NEAR(sent("EgoMotion_Speed"), 10.0, 0.0026);
  EXPECT_TRUE(std::isnan(sent("GroundPlane_Height")));
  EXPECT_TRUE(std::isnan(sent("GroundDetail_HeightStd")));
  EXPECT_NEAR(sent("GroundPlane_Pitch"), 0.01, 0.0001);
  EXPECT_EQ(validity("GroundPlane_Validity"), CanValidity::kDegraded);
  EXPECT_EQ(doubt("Frame_HeightDoubt"), PlausibilityReason::kTooFast);
  EXPECT_EQ(output_.plane_refusal(), PlausibilityReason::kTooFast);
}

TEST_F(LiveDrive, AMessageThatIsLostOnTheWayDoesNotSpoilTheNext) {
  drive(5);
  drive_.step();  // not heard
  drive(1);
  EXPECT_EQ(validity("EgoMotion_Validity"), CanValidity::kValid);
  EXPECT_EQ(validity("OdomX_Validity"), CanValidity::kValid);
  EXPECT_EQ(sent("Status_NumMissed"), 1.0);
}

TEST_F(LiveDrive, AMotionThatIsNotMeasuredLeavesThePoseAlone) {
  drive(5);
  drive_.step();
  ego_motion_t ego = drive_.ego();
  for (double& v : ego.velocity_ground_m_s) v = kNan;
  for (double& v : ego.rate_ground_rad_s) v = kNan;
  for (double& v : ego.t_prev_cam_m) v = kNan;
  for (double& v : ego.q_prev_cam) v = kNan;
  ego.speed_std_m_s = ego.yaw_rate_std_rad_s = kNan;
  ASSERT_EQ(hear(ego, drive_.plane()), nullptr);
  tick();
  EXPECT_EQ(validity("EgoMotion_Validity"), CanValidity::kInvalid);
  EXPECT_EQ(doubt("Frame_SpeedDoubt"), PlausibilityReason::kNotMeasured);
  EXPECT_EQ(validity("OdomX_Validity"), CanValidity::kValid);
  EXPECT_EQ(output_.num_implausible(), 5) << "those of the start: three motions, two planes";
}

TEST_F(LiveDrive, ARestartOfTheSenderIsAReset) {
  output_.set_session(1'000'000'000'000);
  drive(5);
  const double before = sent("OdomDist_ResetCtr");
  drive_.session = 78;  // position and distance begin anew, and so does the counter
  drive_.distance_m = 0.0;
  drive_.utime += 400'000;
  drive(5);
  EXPECT_EQ(sent("OdomDist_ResetCtr"), before + 1.0);
  drive_.reset_counter = 2;
  drive(1);
  EXPECT_EQ(sent("OdomDist_ResetCtr"), before + 3.0);
  drive_.reset_counter = 0;
  drive(1);
  EXPECT_EQ(sent("OdomDist_ResetCtr"), before + 4.0) << "it went back";
  EXPECT_EQ(validity("EgoMotion_Validity"), CanValidity::kValid);
}

TEST_F(LiveDrive, ARestartOfThisProgramIsNoticed) {
  const auto first = [](std::int64_t session_us) {
    CanOutput output{CanConfig{}};
    output.set_session(session_us);
    RecordingSink sink;
    Drive drive;
    (void)output.on_ground_plane(drive.plane(), drive.utime);
    (void)output.on_ego_motion(drive.ego(), drive.utime);
    output.tick(drive.utime, sink);
    return std::pair(sink.newest()["Frame_StartCtr"], sink.newest()["OdomDist_ResetCtr"]);
  };
  constexpr std::int64_t kStartUs = 1'795'000'000'000'000;
  for (const std::int64_t later_us : {100'000LL, 2'000'000LL, 25'500'000LL, 86'400'000'000LL})
    EXPECT_NE(first(kStartUs), first(kStartUs + later_us)) << later_us;
  EXPECT_EQ(first(0), std::pair(0.0, 0.0)) << "a replay begins at 0";
}

TEST_F(LiveDrive, OfTwoSendersOneIsTakenAndTheOtherRefused) {
  drive_.session = 99;
  drive(5);
  Drive other;
  other.session = 55;
  other.speed_m_s = 25.0;
  for (int i = 0; i < 20; ++i) {
    other.step();
    other.utime = drive_.utime + 50'000;
    EXPECT_NE(hear(other.ego(), other.plane()), nullptr);
    drive(1);
  }
  EXPECT_EQ(output_.num_rejected(), 40);
  for (const Reading& v : sink_.all("EgoMotion")) {
    if (v["EgoMotion_Validity"] != 2.0) continue;
    ASSERT_NEAR(v["EgoMotion_Speed"], 10.0, 0.0026);
  }
  EXPECT_EQ(sent("Status_NumRejected"), 40.0);
}

TEST_F(LiveDrive, ASenderThatBeginsAnewIsTakenAtOnce) {
  drive(5);
  drive_.session = 78;
  drive_.seq = 0;
  int num_refused = 0;
  for (int i = 0; i < 10; ++i) {
    drive_.step();
    num_refused += hear(drive_.ego(), drive_.plane()) != nullptr ? 1 : 0;
    tick();
  }
  EXPECT_EQ(num_refused, 0);
  EXPECT_EQ(validity("EgoMotion_Validity"), CanValidity::kValid);
  EXPECT_EQ(sink_.newest().frame_counter(), 10.0);
  EXPECT_EQ(output_.counters().num_missed, 0);
}

TEST_F(LiveDrive, WhatIsOldOnReceiptIsCountedAndNotSent) {
  drive(5);
  delay_us_ = 3'000'000;  // as after a stop of three seconds
  sink_.sent.clear();
  for (int i = 0; i < 30; ++i) {
    drive_.step();
    ASSERT_EQ(hear(drive_.ego(), drive_.plane()), nullptr);
  }
  tick();
  for (const Reading& v : sink_.all("EgoMotion")) EXPECT_TRUE(std::isnan(v["EgoMotion_Validity"]));
  EXPECT_EQ(output_.num_late(), 60);
  EXPECT_EQ(output_.counters().num_passed, 29);
  EXPECT_EQ(sent("Status_Mode"), static_cast<double>(CanMode::kTooOld));
  EXPECT_NEAR(sent("Frame_Age"), 3.08, 0.0006);
  delay_us_ = 30'000;
  drive_.utime += 3'000'000;
  drive_.step();
  ASSERT_EQ(hear(drive_.ego(), drive_.plane()), nullptr);
  tick(1);
  EXPECT_EQ(validity("OdomX_Validity"), CanValidity::kDegraded) << "the first tick has it";
}

}  // namespace
}  // namespace plumb
