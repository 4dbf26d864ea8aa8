#include "modules/can/can_wire.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numbers.hpp"
#include "tests/can/recording_sink.hpp"

namespace plumb {
namespace {

using namespace test;  // NOLINT: the sink and the default messages

ego_motion_t make_ego(std::int64_t seq = 3) {
  ego_motion_t m{};
  m.utime = 1'000'000 + seq * 100'000;
  m.seq = seq;
  m.reason = 2;
  m.reset_counter = 1;
  m.velocity_ground_m_s[0] = 10.0;
  m.velocity_ground_m_s[1] = 0.5;
  m.speed_std_m_s = 0.1;
  m.rate_ground_rad_s[2] = 0.2;
  m.yaw_rate_std_rad_s = 0.01;
  m.accel_forward_m_s2 = 1.0;
  m.accel_forward_std_m_s2 = 0.3;
  m.q_world_cam[0] = 1.0;
  m.t_world_cam_m[0] = -3.0;  // to the left
  m.t_world_cam_m[1] = -0.5;  // up
  m.t_world_cam_m[2] = 40.0;  // forward
  m.distance_m = 41.0;
  m.log_scale_std = 0.02;
  return m;
}

ground_plane_t make_plane(std::int64_t seq = 3) {
  ground_plane_t m{};
  m.utime = 1'000'000 + seq * 100'000;
  m.seq = seq;
  m.reason = 1;
  m.normal_cam[1] = 1.0;
  m.height_m = 1.6;
  m.pitch_rad = 0.01;
  m.roll_rad = -0.02;
  m.cov[0][0] = 1e-6;
  m.cov[1][1] = 4e-6;
  m.cov[2][2] = 1e-4;
  m.num_cues = 3;
  m.cues.resize(3);
  m.cues[0].status = 0;
  m.cues[1].status = 2;
  m.cues[2].status = 0;
  return m;
}

TEST(CanWire, EgoMotionBecomesIso8855) {
  CanSample ego;
  ASSERT_EQ(from_wire(make_ego(), default_messages(), &ego), nullptr);
  EXPECT_EQ(ego.seq, 3);
  EXPECT_EQ(value_of(ego, "EgoDetail_Status"), ego_motion_t::STATUS_OK);
  EXPECT_EQ(value_of(ego, "Status_EgoReason"), 2);
  EXPECT_EQ(value_of(ego, "OdomDist_ResetCtr"), 1);
  EXPECT_EQ(value_of(ego, "EgoMotion_Speed"), 10.0);
  EXPECT_EQ(value_of(ego, "EgoDetail_SpeedY"), 0.5);
  EXPECT_EQ(value_of(ego, "EgoMotion_SpeedStd"), 0.1);
  EXPECT_EQ(value_of(ego, "EgoMotion_YawRate"), 0.2);
  EXPECT_EQ(value_of(ego, "EgoDetail_YawRateStd"), 0.01);
  EXPECT_EQ(value_of(ego, "EgoDetail_AccelX"), 1.0);
  EXPECT_EQ(value_of(ego, "EgoDetail_AccelXStd"), 0.3);
  EXPECT_EQ(value_of(ego, "OdomX_PosX"), 40.0);
  EXPECT_EQ(value_of(ego, "OdomY_PosY"), 3.0);
  EXPECT_EQ(value_of(ego, "OdomY_PosZ"), 0.5);
  EXPECT_EQ(value_of(ego, "OdomX_Heading"), 0.0);
  EXPECT_EQ(value_of(ego, "OdomDist_Distance"), 41.0);
  EXPECT_EQ(value_of(ego, "OdomDist_ScaleStd"), 0.02);
}

TEST(CanWire, ACarThatHasNotMovedYetStandsStillAtNoKnownScale) {
  ego_motion_t m = make_ego();
  m.log_scale_std = kNan;
  CanSample ego;
  EXPECT_NE(from_wire(m, default_messages(), &ego), nullptr) << "moving, it has one";
  m.status = ego_motion_t::STATUS_STANDSTILL;
  ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
  EXPECT_TRUE(std::isnan(value_of(ego, "OdomDist_ScaleStd")));
  m.log_scale_std = -1.0;
  EXPECT_NE(from_wire(m, default_messages(), &ego), nullptr);
}

TEST(CanWire, HeadingIsPositiveAfterALeftTurn) {
  // Left is a negative turn about the camera's y axis, which points down.
  for (const double left_rad : {-3.0, -0.5, 0.25, 1.5, 3.0}) {
    ego_motion_t m = make_ego();
    m.q_world_cam[0] = std::cos(-left_rad / 2);
    m.q_world_cam[2] = std::sin(-left_rad / 2);
    CanSample ego;
    ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
    EXPECT_NEAR(value_of(ego, "OdomX_Heading"), left_rad, 1e-12);
  }
}

TEST(CanWire, HeadingIgnoresPitchOfTheCamera) {
  ego_motion_t m = make_ego();
  m.q_world_cam[0] = std::cos(0.1);
  m.q_world_cam[1] = std::sin(0.1);  // nose up
  CanSample ego;
  ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
  EXPECT_NEAR(value_of(ego, "OdomX_Heading"), 0.0, 1e-12);
}

TEST(CanWire, GroundPlaneKeepsItsSignsAndGivesDeviations) {
  CanSample plane;
  ASSERT_EQ(from_wire(make_plane(), default_messages(), &plane), nullptr);
  EXPECT_EQ(plane.seq, 3);
  EXPECT_EQ(value_of(plane, "GroundDetail_Status"), ground_plane_t::STATUS_OK);
  EXPECT_EQ(value_of(plane, "GroundDetail_Reason"), 1);
  EXPECT_EQ(value_of(plane, "GroundPlane_Pitch"), 0.01);
  EXPECT_EQ(value_of(plane, "GroundPlane_Roll"), -0.02);
  EXPECT_EQ(value_of(plane, "GroundPlane_Height"), 1.6);
  EXPECT_NEAR(value_of(plane, "GroundDetail_PitchStd"), 1e-3, 1e-12);
  EXPECT_NEAR(value_of(plane, "GroundDetail_RollStd"), 2e-3, 1e-12);
  EXPECT_NEAR(value_of(plane, "GroundDetail_HeightStd"), 1.6 * 1e-2, 1e-12);
  EXPECT_EQ(value_of(plane, "GroundDetail_CuesUsed"), 1 + 4);
}

TEST(CanWire, EveryValueThatMustHoldIsChecked) {
  const auto refuses_ego = [](auto change) {
    for (const double bad : {kNan, kInf, -kInf}) {
      ego_motion_t m = make_ego();
      change(m, bad);
      CanSample ego;
      EXPECT_NE(from_wire(m, default_messages(), &ego), nullptr) << bad;
    }
  };
  for (int i = 0; i < 3; ++i) {
    refuses_ego([i](ego_motion_t& m, double bad) { m.velocity_ground_m_s[i] = bad; });
    refuses_ego([i](ego_motion_t& m, double bad) { m.rate_ground_rad_s[i] = bad; });
    refuses_ego([i](ego_motion_t& m, double bad) { m.t_world_cam_m[i] = bad; });
  }
  for (int i = 0; i < 4; ++i) {
    refuses_ego([i](ego_motion_t& m, double bad) { m.q_world_cam[i] = bad; });
  }
  refuses_ego([](ego_motion_t& m, double bad) { m.speed_std_m_s = bad; });
  refuses_ego([](ego_motion_t& m, double bad) { m.yaw_rate_std_rad_s = bad; });
  refuses_ego([](ego_motion_t& m, double bad) { m.distance_m = bad; });
  refuses_ego([](ego_motion_t& m, double bad) { m.log_scale_std = bad; });

  const auto refuses_plane = [](auto change) {
    for (const double bad : {kNan, kInf, -kInf}) {
      ground_plane_t m = make_plane();
      change(m, bad);
      CanSample plane;
      EXPECT_NE(from_wire(m, default_messages(), &plane), nullptr) << bad;
    }
  };
  refuses_plane([](ground_plane_t& m, double bad) { m.pitch_rad = bad; });
  refuses_plane([](ground_plane_t& m, double bad) { m.roll_rad = bad; });
  refuses_plane([](ground_plane_t& m, double bad) { m.height_m = bad; });
  for (int i = 0; i < 3; ++i) {
    refuses_plane([i](ground_plane_t& m, double bad) { m.cov[i][i] = bad; });
  }
}

TEST(CanWire, NumbersOutOfTheirRangeAreRefused) {
  CanSample ego;
  const auto refuses_ego = [&](auto change) {
    ego_motion_t m = make_ego();
    change(m);
    EXPECT_NE(from_wire(m, default_messages(), &ego), nullptr);
  };
  refuses_ego([](ego_motion_t& m) { m.status = -1; });
  refuses_ego([](ego_motion_t& m) { m.status = 6; });
  refuses_ego([](ego_motion_t& m) { m.reason = -1; });
  refuses_ego([](ego_motion_t& m) { m.reason = 15; });
  refuses_ego([](ego_motion_t& m) { m.seq = -1; });
  refuses_ego([](ego_motion_t& m) { m.speed_std_m_s = -0.1; });
  refuses_ego([](ego_motion_t& m) { m.q_world_cam[0] = 2.0; });
  refuses_ego([](ego_motion_t& m) { m.q_world_cam[0] = 0.0; });

  CanSample plane;
  const auto refuses_plane = [&](auto change) {
    ground_plane_t m = make_plane();
    change(m);
    EXPECT_NE(from_wire(m, default_messages(), &plane), nullptr);
  };
  refuses_plane([](ground_plane_t& m) { m.status = -1; });
  refuses_plane([](ground_plane_t& m) { m.status = 4; });
  refuses_plane([](ground_plane_t& m) { m.reason = -1; });
  refuses_plane([](ground_plane_t& m) { m.reason = 15; });
  refuses_plane([](ground_plane_t& m) { m.seq = -1; });
  refuses_plane([](ground_plane_t& m) { m.num_cues = -1; });
  refuses_plane([](ground_plane_t& m) { m.num_cues = 4; });
  refuses_plane([](ground_plane_t& m) { m.num_cues = 127; });
  refuses_plane([](ground_plane_t& m) { m.height_m = 0.0; });
  refuses_plane([](ground_plane_t& m) { m.cov[1][1] = -1e-9; });
}

TEST(CanWire, TheEndsOfEveryRangeAreAccepted) {
  CanSample ego;
  CanSample plane;
  for (const std::int8_t reason : {std::int8_t{0}, std::int8_t{14}}) {
    ego_motion_t m = make_ego(0);
    m.reason = reason;
    EXPECT_EQ(from_wire(m, default_messages(), &ego), nullptr);
    ground_plane_t p = make_plane(0);
    p.reason = reason;
    p.num_cues = 0;
    p.cues.clear();
    EXPECT_EQ(from_wire(p, default_messages(), &plane), nullptr);
    EXPECT_EQ(value_of(plane, "GroundDetail_CuesUsed"), 0);
  }
}

TEST(CanWire, NothingOfAnEarlierMessageIsLeft) {
  CanSample ego;
  ASSERT_EQ(from_wire(make_ego(), default_messages(), &ego), nullptr);
  ego_motion_t lost = make_ego(4);
  lost.status = ego_motion_t::STATUS_LOST;
  ASSERT_EQ(from_wire(lost, default_messages(), &ego), nullptr);
  EXPECT_TRUE(std::isnan(value_of(ego, "EgoMotion_Speed")));
  EXPECT_TRUE(std::isnan(value_of(ego, "OdomDist_Distance")));

  CanSample plane;
  ASSERT_EQ(from_wire(make_plane(), default_messages(), &plane), nullptr);
  ground_plane_t invalid = make_plane(4);
  invalid.status = ground_plane_t::STATUS_INVALID;
  ASSERT_EQ(from_wire(invalid, default_messages(), &plane), nullptr);
  EXPECT_TRUE(std::isnan(value_of(plane, "GroundPlane_Height")));
}

TEST(CanWire, FieldsThatDoNotHoldAreNeitherCheckedNorSent) {
  ego_motion_t m = make_ego();
  m.velocity_ground_m_s[0] = kNan;
  for (const std::int8_t status : {ego_motion_t::STATUS_INITIALIZING, ego_motion_t::STATUS_LOST}) {
    m.status = status;
    CanSample ego;
    ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
    EXPECT_TRUE(std::isnan(value_of(ego, "EgoMotion_YawRate")));
    EXPECT_TRUE(std::isnan(value_of(ego, "OdomX_PosX")));
  }
  ground_plane_t p = make_plane();
  p.height_m = kNan;
  for (const std::int8_t status :
       {ground_plane_t::STATUS_INITIALIZING, ground_plane_t::STATUS_INVALID}) {
    p.status = status;
    CanSample plane;
    ASSERT_EQ(from_wire(p, default_messages(), &plane), nullptr);
    EXPECT_TRUE(std::isnan(value_of(plane, "GroundPlane_Pitch")));
  }
}

TEST(CanWire, AnAccelerationThatCannotBeObservedIsNoError) {
  for (double ego_motion_t::*field :
       {&ego_motion_t::accel_forward_m_s2, &ego_motion_t::accel_forward_std_m_s2}) {
    ego_motion_t m = make_ego();
    m.*field = kNan;
    CanSample ego;
    ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
    EXPECT_TRUE(std::isnan(value_of(ego, "EgoDetail_AccelX")));
    EXPECT_TRUE(std::isnan(value_of(ego, "EgoDetail_AccelXStd")));
  }
}

TEST(CanOutputTest, ARejectedMessageIsCountedAndShown) {
  CanOutput output{CanConfig{}};
  RecordingSink sink;
  ego_motion_t bad_ego = make_ego();
  bad_ego.status = 9;
  ground_plane_t bad_plane = make_plane();
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
    ASSERT_EQ(output->on_ground_plane(make_plane(), 0), nullptr);
    ASSERT_EQ(output->on_ego_motion(make_ego(), 0), nullptr);
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

/// Plays messages through the virtual clock as a replay does.
class VirtualClock : public ::testing::Test {
 protected:
  CanOutput output_{CanConfig{}};
  RecordingSink sink_;

  void play(std::int64_t seq, std::int64_t utime) {
    ground_plane_t plane = make_plane(seq);
    ego_motion_t ego = make_ego(seq);
    output_.advance(utime, sink_);
    EXPECT_EQ(output_.on_ground_plane(plane, utime), nullptr);
    EXPECT_EQ(output_.on_ego_motion(ego, utime), nullptr);
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
  EXPECT_NEAR(absent, 170, 2);
}

TEST_F(VirtualClock, HostileTimesDoNoHarm) {
  for (const std::int64_t utime : {INT64_MIN, INT64_MAX, std::int64_t{0}, INT64_MAX / 4 + 1}) {
    output_.advance(utime, sink_);
    output_.on_ground_plane(make_plane(), utime);
    output_.on_ego_motion(make_ego(), utime);
  }
  output_.finish(sink_);
  EXPECT_LT(sink_.sent.size(), 1000U);
}

}  // namespace
}  // namespace plumb
