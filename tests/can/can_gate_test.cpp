// Tests what the gate sends, and when: cycles, bursts, queue and clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "tests/can/gate_fixture.hpp"

namespace plumb {
namespace {

using namespace test;  // NOLINT: the fixture and its samples

class Gate : public GateFixture {};

TEST_F(Gate, SendsEveryMessageWithItsCycleFromTheFirstTickOn) {
  tick(100);  // one second
  for (const Message& message : default_messages()) {
    if (is_about_objects(message.row->trigger)) continue;
    EXPECT_EQ(sink_.all(message.row->name).size(),
              1000U / static_cast<unsigned>(message.address.cycle_ms))
        << message.row->name;
    std::int64_t last_us = -1;
    for (const test::Sent& s : sink_.sent) {
      if (s.frame.id != message.address.id) continue;
      if (last_us >= 0) {
        EXPECT_EQ(s.time_us - last_us, message.address.cycle_ms * 1000);
      }
      last_us = s.time_us;
    }
  }
}

TEST_F(Gate, WithoutInputEverythingIsNotAvailable) {
  tick();
  const Reading v = sink_.newest();
  EXPECT_TRUE(std::isnan(v["EgoMotion_Validity"]));
  EXPECT_TRUE(std::isnan(v["GroundPlane_Validity"]));
  EXPECT_TRUE(std::isnan(v["EgoDetail_Status"]));
  EXPECT_TRUE(std::isnan(v["GroundDetail_Status"]));
  expect_all_ego_values_absent(v);
  expect_all_plane_values_absent(v);
  EXPECT_EQ(v["Status_Mode"], static_cast<double>(CanMode::kNoInput));
  EXPECT_EQ(v["Info_DatabaseVersion"], kDatabaseVersion);
}

TEST_F(Gate, SendsTheValuesItWasGiven) {
  give(7);
  tick();
  const Reading v = sink_.newest();
  EXPECT_EQ(v.frame_counter(), 7.0);
  EXPECT_EQ(v["EgoMotion_Validity"], kValid);
  EXPECT_NEAR(v["EgoMotion_Speed"], 12.5, 0.0025);
  EXPECT_NEAR(v["EgoMotion_YawRate"], 0.1, 0.000025);
  EXPECT_NEAR(v["EgoMotion_SpeedStd"], 0.1, 0.01);
  EXPECT_NEAR(v["EgoDetail_SpeedY"], -0.2, 0.01);
  EXPECT_NEAR(v["EgoDetail_AccelX"], -1.5, 0.005);
  EXPECT_NEAR(v["EgoDetail_AccelXStd"], 0.2, 0.01);
  EXPECT_NEAR(v["EgoDetail_YawRateStd"], 0.001, 0.00005);
  EXPECT_EQ(v["EgoMotion_Standstill"], 0.0);
  EXPECT_EQ(v["GroundPlane_Validity"], kValid);
  EXPECT_NEAR(v["GroundPlane_Pitch"], 0.01, 0.00001);
  EXPECT_NEAR(v["GroundPlane_Roll"], -0.02, 0.0001);
  EXPECT_NEAR(v["GroundPlane_Height"], 1.65, 0.0005);
  EXPECT_NEAR(v["GroundDetail_PitchStd"], 0.002, 0.000025);
  EXPECT_NEAR(v["GroundDetail_RollStd"], 0.003, 0.000025);
  EXPECT_NEAR(v["GroundDetail_HeightStd"], 0.02, 0.00025);
  EXPECT_EQ(v["GroundDetail_CuesUsed"], 3.0);
  EXPECT_NEAR(v["OdomX_PosX"], 100.0, 0.0025);
  EXPECT_NEAR(v["OdomY_PosY"], -20.0, 0.0025);
  EXPECT_NEAR(v["OdomY_PosZ"], 1.0, 0.025);
  EXPECT_NEAR(v["OdomX_Heading"], 0.5, 0.00005);
  EXPECT_NEAR(v["OdomDist_Distance"], 120.0, 0.032);
  EXPECT_NEAR(v["OdomDist_ScaleStd"], 0.02, 0.001);
  EXPECT_EQ(v["Status_Mode"], static_cast<double>(CanMode::kNormal));
}

TEST_F(Gate, ACameraFrameLeavesInOneBurst) {
  tick();
  sink_.sent.clear();
  give(9);
  tick();
  ASSERT_GE(sink_.sent.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(sink_.sent[i].frame.id, default_messages()[i].address.id);
    EXPECT_EQ(sink_.sent[i].time_us, sink_.sent[0].time_us);
    EXPECT_EQ(sink_.sent[i].frame.data[2], 9)
        << "frame counter of " << default_messages()[i].row->name;
  }
}

TEST_F(Gate, OdometryDoesNotWaitForItsCycleWhenAFrameIsNew) {
  tick();  // odometry is not due again for 20 ms
  sink_.sent.clear();
  give(1);
  tick();
  EXPECT_EQ(sink_.all("OdometryX").size(), 1U);
  tick();
  EXPECT_EQ(sink_.all("OdometryX").size(), 1U) << "and its cycle begins anew";
  tick();
  EXPECT_EQ(sink_.all("OdometryX").size(), 2U);
}

TEST_F(Gate, TwoFramesBetweenTicksAreBothSent) {
  give(1);
  give(2);
  tick(2);
  EXPECT_EQ(frames_sent(), (std::vector<int>{1, 2}));
  EXPECT_EQ(frames_sent("OdometryX"), (std::vector<int>{1, 2}));
  EXPECT_EQ(frames_sent("GroundPlane"), (std::vector<int>{1, 2}));
  EXPECT_TRUE(gate_.idle());
}

TEST_F(Gate, FiftyFramesPerSecondWithJitterAreAllSent) {
  std::mt19937 random(3);
  std::vector<std::int64_t> arrivals_us;
  for (int i = 0; i < 500; ++i) {
    arrivals_us.push_back(now_us_ + i * 20'000 + static_cast<int>(random() % 60'000));
  }
  std::sort(arrivals_us.begin(), arrivals_us.end());
  std::size_t next = 0;
  for (int i = 0; i < 1100; ++i) {
    for (; next < arrivals_us.size() && arrivals_us[next] <= now_us_; ++next) {
      give(static_cast<std::int64_t>(next));
    }
    tick();
  }
  EXPECT_EQ(gate_.counters().num_frames, 500);
  EXPECT_EQ(gate_.counters().num_overflowed, 0);
  const std::vector<int> sent = frames_sent();
  ASSERT_EQ(sent.size(), 500U);
  for (std::size_t i = 0; i < sent.size(); ++i) EXPECT_EQ(sent[i], static_cast<int>(i % 256));
}

TEST_F(Gate, AnOverflowDropsTheOldestAndIsCountedAndShown) {
  CanConfig patient;
  patient.stale_s = 5.0;
  gate_ = CanGate(patient, default_messages());
  const int num_frames = static_cast<int>(CanGate::kMaxPending) + 4;
  for (int seq = 0; seq < num_frames; ++seq) give(seq);
  EXPECT_EQ(gate_.counters().num_overflowed, 4);
  tick(num_frames);
  const std::vector<int> sent = frames_sent();
  ASSERT_EQ(sent.size(), CanGate::kMaxPending);
  EXPECT_EQ(sent.front(), 4);
  EXPECT_EQ(sent.back(), num_frames - 1);
  EXPECT_EQ(sink_.newest()["Status_NumOverflowed"], 4.0);
}

TEST_F(Gate, RepeatsTheValuesUntilTheNextFrame) {
  give(5);
  tick(8);
  const std::vector<Reading> list = sink_.all("EgoMotion");
  ASSERT_EQ(list.size(), 8U);
  for (const Reading& v : list) {
    EXPECT_EQ(v.frame_counter(), 5.0);
    EXPECT_NEAR(v["EgoMotion_Speed"], 12.5, 0.0025);
  }
}

TEST_F(Gate, CountersStayAtTheLargestValueInsteadOfWrapping) {
  give(0);
  give(300);
  gate_.report(1'000'000, 255);
  tick(10);
  const Reading v = sink_.newest();
  EXPECT_EQ(v["Status_NumMissed"], 254.0);
  EXPECT_EQ(v["Status_NumRejected"], 254.0);
  EXPECT_EQ(v["Status_NumUnsent"], 254.0);
  EXPECT_EQ(v["Status_NumOverflowed"], 0.0);
}

TEST_F(Gate, ResetCounterNeverSaysNotAvailable) {
  ego_motion_t ego = make_ego(1);
  ego.reset_counter = 255;
  hear(make_plane(1));
  hear(ego);
  tick();
  EXPECT_EQ(sink_.newest()["OdomDist_ResetCtr"], 0.0);
}

TEST_F(Gate, AliveCounterRunsFromZeroToFourteenPerMessage) {
  give(1);
  tick(64);
  std::map<std::uint32_t, int> next;
  for (const test::Sent& s : sink_.sent) {
    EXPECT_EQ(s.frame.data[1] & 0x0F, next[s.frame.id]);
    next[s.frame.id] = (next[s.frame.id] + 1) % 15;
  }
}

TEST_F(Gate, AClockThatRunsBackwardsMakesValuesNotAvailable) {
  give(1);
  now_us_ = -5;
  tick();
  EXPECT_TRUE(std::isnan(sink_.newest()["EgoMotion_Validity"]));
}

TEST_F(Gate, ExtremeTimesDoNoHarm) {
  now_us_ = INT64_MIN;
  give(1);
  gate_.tick(now_us_, sink_);
  EXPECT_EQ(sink_.newest()["EgoMotion_Validity"], kValid);
  gate_.tick(INT64_MAX, sink_);
  EXPECT_TRUE(std::isnan(sink_.all("EgoMotion").back()["EgoMotion_Validity"]));
  now_us_ = INT64_MAX;
  give(2);
  gate_.tick(now_us_, sink_);
  EXPECT_EQ(sink_.newest()["EgoMotion_Validity"], kValid);
}

TEST_F(Gate, UptimeCountsFromTheFirstTickAndSaturates) {
  tick();
  EXPECT_EQ(sink_.newest()["Info_Uptime"], 0.0);
  tick(300);
  EXPECT_EQ(sink_.newest()["Info_Uptime"], 3.0);
  now_us_ += 100'000'000'000;
  tick(100);
  EXPECT_EQ(sink_.newest()["Info_Uptime"], 65534.0);
}

TEST_F(Gate, TheSameInputGivesTheSameFrames) {
  const auto run = [] {
    CanGate gate{CanConfig{}, default_messages()};
    test::RecordingSink sink;
    for (int i = 0; i < 200; ++i) {
      ego_motion_t ego = make_ego(i / 7);
      ego.velocity_ground_m_s[0] = 0.1 * i;
      ego.capture_mono_us = i * 10'000;
      gate.on_ground_plane(sample_of(make_plane(i / 7)), i * 10'000);
      gate.on_ego_motion(sample_of(ego), i * 10'000);
      gate.tick(i * 10'000, sink);
    }
    return sink.sent;
  };
  const auto a = run();
  const auto b = run();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].time_us, b[i].time_us);
    EXPECT_EQ(a[i].frame.data, b[i].frame.data);
  }
}

}  // namespace
}  // namespace plumb
