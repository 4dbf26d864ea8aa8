// Tests the virtual clock, on which a replay sends.
#include <gtest/gtest.h>

#include <cmath>

#include "modules/can/can_wire.hpp"
#include "tests/can/drive.hpp"
#include "tests/can/recording_sink.hpp"

namespace plumb {
namespace {

using namespace test;  // NOLINT: the drive, the sink and the default messages

/// Plays messages through the virtual clock as a replay does.
class VirtualClock : public ::testing::Test {
 protected:
  CanOutput output_{CanConfig{}};
  RecordingSink sink_;

  void play(std::int64_t seq, std::int64_t utime) {
    Drive drive;
    drive.seq = seq;
    drive.utime = utime;
    output_.advance(utime, sink_);
    EXPECT_EQ(output_.on_ground_plane(drive.plane(), utime), nullptr);
    EXPECT_EQ(output_.on_ego_motion(drive.ego(), utime), nullptr);
  }
};

TEST_F(VirtualClock, TicksEveryTenMillisecondsOfTheLogsTime) {
  for (int i = 0; i < 11; ++i) play(i, 5'000'000 + i * 100'000);
  EXPECT_EQ(sink_.all("EgoMotion").size(), 101U);
  EXPECT_EQ(sink_.sent.front().time_us, 5'000'000);
  EXPECT_EQ(sink_.sent.back().time_us, 6'000'000);
  EXPECT_EQ(output_.counters().num_frames, 10);
  output_.finish(sink_);
  EXPECT_EQ(output_.counters().num_frames, 11);
  EXPECT_EQ(sink_.newest().frame_counter(), 10.0);
}

TEST_F(VirtualClock, KeepsItsGridWhenMessagesComeBetweenTicks) {
  for (int i = 0; i < 30; ++i) play(i, 1'000'000 + i * 33'333);
  std::int64_t last_us = 0;
  for (const Sent& s : sink_.sent) {
    if (s.frame.id != default_messages()[0].address.id) continue;
    if (last_us != 0) {
      EXPECT_EQ(s.time_us - last_us, CanGate::kTickUs);
    }
    last_us = s.time_us;
  }
}

TEST_F(VirtualClock, FinishWithoutInputSendsNothing) {
  output_.finish(sink_);
  EXPECT_TRUE(sink_.sent.empty());
}

TEST_F(VirtualClock, ASmallStepBackIsNoReasonToStartOver) {
  play(0, 1'000'000);
  play(1, 995'000);
  output_.finish(sink_);
  EXPECT_EQ(output_.counters().num_frames, 2);
}

TEST_F(VirtualClock, JumpsKeepEveryFrame) {
  std::int64_t seq = 0;
  for (const std::int64_t utime :
       {std::int64_t{1'000'000}, std::int64_t{1'100'000}, std::int64_t{86'400'000'000},
        std::int64_t{2'000'000}, std::int64_t{-7'000'000}}) {
    play(seq++, utime);
  }
  output_.finish(sink_);
  EXPECT_EQ(output_.counters().num_frames, seq);
  EXPECT_LT(sink_.sent.size(), 1000U) << "a day's jump is not a day of frames";
  int valid = 0;
  double last = -1.0;
  for (const Reading& v : sink_.all("EgoMotion")) {
    if (!std::isnan(v["EgoMotion_Validity"]) && v.frame_counter() != last) {
      ++valid;
      last = v.frame_counter();
    }
  }
  EXPECT_EQ(valid, seq) << "each was sent as available";
}

TEST_F(VirtualClock, ASilenceInTheLogIsNotAvailable) {
  play(0, 1'000'000);
  play(1, 3'000'000);
  int absent = 0;
  for (const Reading& v : sink_.all("EgoMotion"))
    absent += std::isnan(v["EgoMotion_Validity"]) ? 1 : 0;
  EXPECT_NEAR(absent, 175, 2);
}

TEST_F(VirtualClock, HostileTimesDoNoHarm) {
  for (const std::int64_t utime : {INT64_MIN, INT64_MAX, std::int64_t{0}, INT64_MAX / 4 + 1}) {
    output_.advance(utime, sink_);
    output_.on_ground_plane(Drive().plane(), utime);
    output_.on_ego_motion(Drive().ego(), utime);
  }
  output_.finish(sink_);
  EXPECT_LT(sink_.sent.size(), 1000U);
}

}  // namespace
}  // namespace plumb
