#include "modules/can/can_wire.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numbers.hpp"
#include "tests/can/recording_sink.hpp"

namespace plumb {
namespace {

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
  CanEgo ego;
  ASSERT_TRUE(from_wire(make_ego(), &ego));
  EXPECT_EQ(ego.seq, 3);
  EXPECT_EQ(ego.status, CanEgoStatus::kOk);
  EXPECT_EQ(ego.reason, 2);
  EXPECT_EQ(ego.reset_counter, 1);
  EXPECT_EQ(ego.speed_m_s, 10.0);
  EXPECT_EQ(ego.lateral_speed_m_s, 0.5);
  EXPECT_EQ(ego.speed_std_m_s, 0.1);
  EXPECT_EQ(ego.yaw_rate_rad_s, 0.2);
  EXPECT_EQ(ego.yaw_rate_std_rad_s, 0.01);
  EXPECT_EQ(ego.accel_m_s2, 1.0);
  EXPECT_EQ(ego.accel_std_m_s2, 0.3);
  EXPECT_EQ(ego.x_m, 40.0);
  EXPECT_EQ(ego.y_m, 3.0);
  EXPECT_EQ(ego.z_m, 0.5);
  EXPECT_EQ(ego.heading_rad, 0.0);
  EXPECT_EQ(ego.distance_m, 41.0);
  EXPECT_EQ(ego.scale_std_ratio, 0.02);
}

TEST(CanWire, ACarThatHasNotMovedYetStandsStillAtNoKnownScale) {
  ego_motion_t m = make_ego();
  m.log_scale_std = kNan;
  CanEgo ego;
  EXPECT_FALSE(from_wire(m, &ego)) << "moving, it has one";
  m.status = ego_motion_t::STATUS_STANDSTILL;
  ASSERT_TRUE(from_wire(m, &ego));
  EXPECT_TRUE(std::isnan(ego.scale_std_ratio));
  m.log_scale_std = -1.0;
  EXPECT_FALSE(from_wire(m, &ego));
}

TEST(CanWire, HeadingIsPositiveAfterALeftTurn) {
  // Left is a negative turn about the camera's y axis, which points down.
  for (const double left_rad : {-3.0, -0.5, 0.25, 1.5, 3.0}) {
    ego_motion_t m = make_ego();
    m.q_world_cam[0] = std::cos(-left_rad / 2);
    m.q_world_cam[2] = std::sin(-left_rad / 2);
    CanEgo ego;
    ASSERT_TRUE(from_wire(m, &ego));
    EXPECT_NEAR(ego.heading_rad, left_rad, 1e-12);
  }
}

TEST(CanWire, HeadingIgnoresPitchOfTheCamera) {
  ego_motion_t m = make_ego();
  m.q_world_cam[0] = std::cos(0.1);
  m.q_world_cam[1] = std::sin(0.1);  // nose up
  CanEgo ego;
  ASSERT_TRUE(from_wire(m, &ego));
  EXPECT_NEAR(ego.heading_rad, 0.0, 1e-12);
}

TEST(CanWire, GroundPlaneKeepsItsSignsAndGivesDeviations) {
  CanPlane plane;
  ASSERT_TRUE(from_wire(make_plane(), &plane));
  EXPECT_EQ(plane.seq, 3);
  EXPECT_EQ(plane.status, CanPlaneStatus::kOk);
  EXPECT_EQ(plane.reason, 1);
  EXPECT_EQ(plane.pitch_rad, 0.01);
  EXPECT_EQ(plane.roll_rad, -0.02);
  EXPECT_EQ(plane.height_m, 1.6);
  EXPECT_NEAR(plane.pitch_std_rad, 1e-3, 1e-12);
  EXPECT_NEAR(plane.roll_std_rad, 2e-3, 1e-12);
  EXPECT_NEAR(plane.height_std_m, 1.6 * 1e-2, 1e-12);
  EXPECT_EQ(plane.cues_used, 1 + 4);
}

TEST(CanWire, EveryValueThatMustHoldIsChecked) {
  const auto refuses_ego = [](auto change) {
    for (const double bad : {kNan, kInf, -kInf}) {
      ego_motion_t m = make_ego();
      change(m, bad);
      CanEgo ego;
      EXPECT_FALSE(from_wire(m, &ego)) << bad;
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
      CanPlane plane;
      EXPECT_FALSE(from_wire(m, &plane)) << bad;
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
  CanEgo ego;
  const auto refuses_ego = [&](auto change) {
    ego_motion_t m = make_ego();
    change(m);
    EXPECT_FALSE(from_wire(m, &ego));
  };
  refuses_ego([](ego_motion_t& m) { m.status = -1; });
  refuses_ego([](ego_motion_t& m) { m.status = 6; });
  refuses_ego([](ego_motion_t& m) { m.reason = -1; });
  refuses_ego([](ego_motion_t& m) { m.reason = 15; });
  refuses_ego([](ego_motion_t& m) { m.seq = -1; });
  refuses_ego([](ego_motion_t& m) { m.speed_std_m_s = -0.1; });
  refuses_ego([](ego_motion_t& m) { m.q_world_cam[0] = 2.0; });
  refuses_ego([](ego_motion_t& m) { m.q_world_cam[0] = 0.0; });

  CanPlane plane;
  const auto refuses_plane = [&](auto change) {
    ground_plane_t m = make_plane();
    change(m);
    EXPECT_FALSE(from_wire(m, &plane));
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
  CanEgo ego;
  CanPlane plane;
  for (const std::int8_t reason : {std::int8_t{0}, std::int8_t{14}}) {
    ego_motion_t m = make_ego(0);
    m.reason = reason;
    EXPECT_TRUE(from_wire(m, &ego));
    ground_plane_t p = make_plane(0);
    p.reason = reason;
    p.num_cues = 0;
    p.cues.clear();
    EXPECT_TRUE(from_wire(p, &plane));
    EXPECT_EQ(plane.cues_used, 0);
  }
}

TEST(CanWire, NothingOfAnEarlierMessageIsLeft) {
  CanEgo ego;
  ASSERT_TRUE(from_wire(make_ego(), &ego));
  ego_motion_t lost = make_ego(4);
  lost.status = ego_motion_t::STATUS_LOST;
  ASSERT_TRUE(from_wire(lost, &ego));
  EXPECT_TRUE(std::isnan(ego.speed_m_s));
  EXPECT_TRUE(std::isnan(ego.distance_m));

  CanPlane plane;
  ASSERT_TRUE(from_wire(make_plane(), &plane));
  ground_plane_t invalid = make_plane(4);
  invalid.status = ground_plane_t::STATUS_INVALID;
  ASSERT_TRUE(from_wire(invalid, &plane));
  EXPECT_TRUE(std::isnan(plane.height_m));
}

TEST(CanWire, FieldsThatDoNotHoldAreNeitherCheckedNorSent) {
  ego_motion_t m = make_ego();
  m.velocity_ground_m_s[0] = kNan;
  for (const std::int8_t status : {ego_motion_t::STATUS_INITIALIZING, ego_motion_t::STATUS_LOST}) {
    m.status = status;
    CanEgo ego;
    ASSERT_TRUE(from_wire(m, &ego));
    EXPECT_TRUE(std::isnan(ego.yaw_rate_rad_s));
    EXPECT_TRUE(std::isnan(ego.x_m));
  }
  ground_plane_t p = make_plane();
  p.height_m = kNan;
  for (const std::int8_t status :
       {ground_plane_t::STATUS_INITIALIZING, ground_plane_t::STATUS_INVALID}) {
    p.status = status;
    CanPlane plane;
    ASSERT_TRUE(from_wire(p, &plane));
    EXPECT_TRUE(std::isnan(plane.pitch_rad));
  }
}

TEST(CanWire, AnAccelerationThatCannotBeObservedIsNoError) {
  for (double ego_motion_t::*field :
       {&ego_motion_t::accel_forward_m_s2, &ego_motion_t::accel_forward_std_m_s2}) {
    ego_motion_t m = make_ego();
    m.*field = kNan;
    CanEgo ego;
    ASSERT_TRUE(from_wire(m, &ego));
    EXPECT_TRUE(std::isnan(ego.accel_m_s2));
    EXPECT_TRUE(std::isnan(ego.accel_std_m_s2));
  }
}

TEST(CanOutputTest, ARejectedMessageIsCountedAndShown) {
  CanOutput output{CanConfig{}};
  test::RecordingSink sink;
  ego_motion_t bad_ego = make_ego();
  bad_ego.status = 9;
  ground_plane_t bad_plane = make_plane();
  bad_plane.status = 9;
  EXPECT_FALSE(output.on_ego_motion(bad_ego, 0));
  EXPECT_FALSE(output.on_ground_plane(bad_plane, 0));
  EXPECT_EQ(output.num_rejected(), 2);
  output.report(1, 5);
  output.tick(0, sink);
  EXPECT_EQ(sink.newest().num_rejected, 3.0);
  EXPECT_EQ(sink.newest().num_unsent, 5.0);
  EXPECT_TRUE(std::isnan(sink.newest().ego_validity));
}

/// Plays messages through the virtual clock as a replay does.
class VirtualClock : public ::testing::Test {
 protected:
  CanOutput output_{CanConfig{}};
  test::RecordingSink sink_;

  void play(std::int64_t seq, std::int64_t utime) {
    ground_plane_t plane = make_plane(seq);
    ego_motion_t ego = make_ego(seq);
    output_.advance(utime, sink_);
    EXPECT_TRUE(output_.on_ground_plane(plane, utime));
    EXPECT_TRUE(output_.on_ego_motion(ego, utime));
  }
};

TEST_F(VirtualClock, TicksEveryTenMillisecondsOfTheLogsTime) {
  for (int i = 0; i < 11; ++i) play(i, 5'000'000 + i * 100'000);
  EXPECT_EQ(sink_.all("PLB_EgoMotion").size(), 101U);
  EXPECT_EQ(sink_.sent.front().time_us, 5'000'000);
  EXPECT_EQ(sink_.sent.back().time_us, 6'000'000);
  EXPECT_EQ(output_.counters().num_frames, 10);
  output_.finish(sink_);
  EXPECT_EQ(output_.counters().num_frames, 11);
  EXPECT_EQ(sink_.newest().frame_counter, 10.0);
}

TEST_F(VirtualClock, KeepsItsGridWhenMessagesComeBetweenTicks) {
  for (int i = 0; i < 30; ++i) play(i, 1'000'000 + i * 33'333);
  std::int64_t last_us = 0;
  for (const test::Sent& s : sink_.sent) {
    if (s.frame.id != messages()[0].id) continue;
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
  for (const CanValues& v : sink_.all("PLB_EgoMotion")) {
    if (!std::isnan(v.ego_validity) && v.frame_counter != last) {
      ++valid;
      last = v.frame_counter;
    }
  }
  EXPECT_EQ(valid, seq) << "each was sent as available";
}

TEST_F(VirtualClock, ASilenceInTheLogIsNotAvailable) {
  play(0, 1'000'000);
  play(1, 3'000'000);
  int absent = 0;
  for (const CanValues& v : sink_.all("PLB_EgoMotion"))
    absent += std::isnan(v.ego_validity) ? 1 : 0;
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
