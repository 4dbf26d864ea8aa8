#include "modules/can/can_gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "tests/can/recording_sink.hpp"

namespace plumb {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInvalid = static_cast<double>(CanValidity::kInvalid);
constexpr double kDegraded = static_cast<double>(CanValidity::kDegraded);
constexpr double kValid = static_cast<double>(CanValidity::kValid);

CanEgo make_ego(std::int64_t seq, CanEgoStatus status = CanEgoStatus::kOk) {
  CanEgo ego;
  ego.seq = seq;
  ego.status = status;
  ego.speed_m_s = 12.5;
  ego.speed_std_m_s = 0.1;
  ego.lateral_speed_m_s = -0.2;
  ego.yaw_rate_rad_s = 0.1;
  ego.yaw_rate_std_rad_s = 0.001;
  ego.accel_m_s2 = -1.5;
  ego.accel_std_m_s2 = 0.2;
  ego.x_m = 100.0;
  ego.y_m = -20.0;
  ego.z_m = 1.0;
  ego.heading_rad = 0.5;
  ego.distance_m = 120.0;
  ego.scale_std_ratio = 0.02;
  return ego;
}

CanPlane make_plane(std::int64_t seq, CanPlaneStatus status = CanPlaneStatus::kOk) {
  CanPlane plane;
  plane.seq = seq;
  plane.status = status;
  plane.pitch_rad = 0.01;
  plane.roll_rad = -0.02;
  plane.height_m = 1.65;
  plane.pitch_std_rad = 0.002;
  plane.roll_std_rad = 0.003;
  plane.height_std_m = 0.02;
  plane.cues_used = 3;
  return plane;
}

class Gate : public ::testing::Test {
 protected:
  CanConfig config_;
  CanGate gate_{config_};
  test::RecordingSink sink_;
  std::int64_t now_us_ = 1'000'000;

  void give(std::int64_t seq) {
    gate_.on_ground_plane(make_plane(seq), now_us_);
    gate_.on_ego_motion(make_ego(seq), now_us_);
  }
  void tick(int num_ticks = 1) {
    for (int i = 0; i < num_ticks; ++i) {
      gate_.tick(now_us_, sink_);
      now_us_ += CanGate::kTickUs;
    }
  }
  /// Ego motion's frame counters in the order of transmission, repeats removed.
  std::vector<int> frames_sent(const char* message = "PLB_EgoMotion") {
    std::vector<int> result;
    for (const CanValues& v : sink_.all(message)) {
      const int counter = static_cast<int>(v.frame_counter);
      if (std::isnan(v.ego_validity) && std::isnan(v.plane_validity)) continue;
      if (result.empty() || result.back() != counter) result.push_back(counter);
    }
    return result;
  }
  void expect_all_ego_values_absent(const CanValues& v) {
    for (const double value :
         {v.standstill, v.speed_m_s, v.yaw_rate_rad_s, v.speed_std_m_s, v.lateral_speed_m_s,
          v.accel_m_s2, v.accel_std_m_s2, v.yaw_rate_std_rad_s, v.x_m, v.y_m, v.z_m, v.heading_rad,
          v.distance_m, v.scale_std_ratio}) {
      EXPECT_TRUE(std::isnan(value));
    }
  }
  void expect_all_plane_values_absent(const CanValues& v) {
    for (const double value :
         {v.pitch_rad, v.roll_rad, v.height_m, v.pitch_std_rad, v.roll_std_rad, v.height_std_m}) {
      EXPECT_TRUE(std::isnan(value));
    }
  }
};

TEST_F(Gate, SendsEveryMessageWithItsCycleFromTheFirstTickOn) {
  tick(100);  // one second
  for (const Message& message : messages()) {
    EXPECT_EQ(sink_.all(message.name).size(), 1000U / static_cast<unsigned>(message.cycle_ms))
        << message.name;
    std::int64_t last_us = -1;
    for (const test::Sent& s : sink_.sent) {
      if (s.frame.id != message.id) continue;
      if (last_us >= 0) {
        EXPECT_EQ(s.time_us - last_us, message.cycle_ms * 1000);
      }
      last_us = s.time_us;
    }
  }
}

TEST_F(Gate, WithoutInputEverythingIsNotAvailable) {
  tick();
  const CanValues v = sink_.newest();
  EXPECT_TRUE(std::isnan(v.ego_validity));
  EXPECT_TRUE(std::isnan(v.plane_validity));
  EXPECT_TRUE(std::isnan(v.ego_status));
  EXPECT_TRUE(std::isnan(v.plane_status));
  expect_all_ego_values_absent(v);
  expect_all_plane_values_absent(v);
  EXPECT_EQ(v.mode, static_cast<double>(CanMode::kNoInput));
  EXPECT_EQ(v.database_version, kDatabaseVersion);
}

TEST_F(Gate, SendsTheValuesItWasGiven) {
  give(7);
  tick();
  const CanValues v = sink_.newest();
  EXPECT_EQ(v.frame_counter, 7.0);
  EXPECT_EQ(v.ego_validity, kValid);
  EXPECT_NEAR(v.speed_m_s, 12.5, 0.0025);
  EXPECT_NEAR(v.yaw_rate_rad_s, 0.1, 0.000025);
  EXPECT_NEAR(v.speed_std_m_s, 0.1, 0.01);
  EXPECT_NEAR(v.lateral_speed_m_s, -0.2, 0.01);
  EXPECT_NEAR(v.accel_m_s2, -1.5, 0.005);
  EXPECT_NEAR(v.accel_std_m_s2, 0.2, 0.01);
  EXPECT_NEAR(v.yaw_rate_std_rad_s, 0.001, 0.00005);
  EXPECT_EQ(v.standstill, 0.0);
  EXPECT_EQ(v.plane_validity, kValid);
  EXPECT_NEAR(v.pitch_rad, 0.01, 0.00001);
  EXPECT_NEAR(v.roll_rad, -0.02, 0.0001);
  EXPECT_NEAR(v.height_m, 1.65, 0.0005);
  EXPECT_NEAR(v.pitch_std_rad, 0.002, 0.000025);
  EXPECT_NEAR(v.roll_std_rad, 0.003, 0.000025);
  EXPECT_NEAR(v.height_std_m, 0.02, 0.00025);
  EXPECT_EQ(v.cues_used, 3.0);
  EXPECT_NEAR(v.x_m, 100.0, 0.0025);
  EXPECT_NEAR(v.y_m, -20.0, 0.0025);
  EXPECT_NEAR(v.z_m, 1.0, 0.025);
  EXPECT_NEAR(v.heading_rad, 0.5, 0.00005);
  EXPECT_NEAR(v.distance_m, 120.0, 0.025);
  EXPECT_NEAR(v.scale_std_ratio, 0.02, 0.001);
  EXPECT_EQ(v.mode, static_cast<double>(CanMode::kNormal));
}

TEST_F(Gate, ACameraFrameLeavesInOneBurst) {
  tick();
  sink_.sent.clear();
  give(9);
  tick();
  ASSERT_GE(sink_.sent.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(sink_.sent[i].frame.id, messages()[i].id);
    EXPECT_EQ(sink_.sent[i].time_us, sink_.sent[0].time_us);
    EXPECT_EQ(sink_.sent[i].frame.data[2], 9) << "frame counter of " << messages()[i].name;
  }
}

TEST_F(Gate, OdometryDoesNotWaitForItsCycleWhenAFrameIsNew) {
  tick();  // odometry is not due again for 20 ms
  sink_.sent.clear();
  give(1);
  tick();
  EXPECT_EQ(sink_.all("PLB_OdometryX").size(), 1U);
  tick();
  EXPECT_EQ(sink_.all("PLB_OdometryX").size(), 1U) << "and its cycle begins anew";
  tick();
  EXPECT_EQ(sink_.all("PLB_OdometryX").size(), 2U);
}

TEST_F(Gate, TwoFramesBetweenTicksAreBothSent) {
  give(1);
  give(2);
  tick(2);
  EXPECT_EQ(frames_sent(), (std::vector<int>{1, 2}));
  EXPECT_EQ(frames_sent("PLB_OdometryX"), (std::vector<int>{1, 2}));
  EXPECT_EQ(frames_sent("PLB_GroundPlane"), (std::vector<int>{1, 2}));
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
  gate_ = CanGate(patient);
  const int num_frames = static_cast<int>(CanGate::kMaxPending) + 4;
  for (int seq = 0; seq < num_frames; ++seq) give(seq);
  EXPECT_EQ(gate_.counters().num_overflowed, 4);
  tick(num_frames);
  const std::vector<int> sent = frames_sent();
  ASSERT_EQ(sent.size(), CanGate::kMaxPending);
  EXPECT_EQ(sent.front(), 4);
  EXPECT_EQ(sent.back(), num_frames - 1);
  EXPECT_EQ(sink_.newest().num_overflowed, 4.0);
}

TEST_F(Gate, RepeatsTheValuesUntilTheNextFrame) {
  give(5);
  tick(8);
  const std::vector<CanValues> list = sink_.all("PLB_EgoMotion");
  ASSERT_EQ(list.size(), 8U);
  for (const CanValues& v : list) {
    EXPECT_EQ(v.frame_counter, 5.0);
    EXPECT_NEAR(v.speed_m_s, 12.5, 0.0025);
  }
}

TEST_F(Gate, StaleValuesAreNotAvailableWithinOneCycle) {
  give(1);
  const std::int64_t limit_us = now_us_ + 300'000;
  while (now_us_ <= limit_us) {
    tick();
    ASSERT_EQ(sink_.newest().ego_validity, kValid);
  }
  tick();  // the cycle of the motion and the plane
  EXPECT_TRUE(std::isnan(sink_.all("PLB_EgoMotion").back().ego_validity));
  EXPECT_TRUE(std::isnan(sink_.all("PLB_EgoMotion").back().speed_m_s));
  EXPECT_TRUE(std::isnan(sink_.all("PLB_EgoMotionDetail").back().ego_status));
  EXPECT_TRUE(std::isnan(sink_.all("PLB_GroundPlane").back().plane_validity));
  EXPECT_TRUE(std::isnan(sink_.all("PLB_GroundPlane").back().height_m));
  EXPECT_TRUE(std::isnan(sink_.all("PLB_GroundPlaneDetail").back().plane_status));
  EXPECT_TRUE(std::isnan(sink_.all("PLB_GroundPlaneDetail").back().cues_used));
  tick();  // the cycle of the odometry
  const CanValues v = sink_.newest();
  expect_all_ego_values_absent(v);
  expect_all_plane_values_absent(v);
  EXPECT_TRUE(std::isnan(v.reset_counter));
  EXPECT_EQ(v.frame_counter, 1.0) << "still names the last frame";
  tick(10);
  EXPECT_EQ(sink_.newest().mode, static_cast<double>(CanMode::kNoInput));
}

TEST_F(Gate, RecoversWithTheFirstFrameAfterSilence) {
  give(1);
  tick(100);
  ASSERT_TRUE(std::isnan(sink_.newest().speed_m_s));
  give(2);
  tick();
  EXPECT_EQ(sink_.newest().ego_validity, kValid);
  EXPECT_EQ(sink_.newest().frame_counter, 2.0);
}

TEST_F(Gate, AFrameThatWaitedTooLongIsSentAsNotAvailable) {
  give(1);
  now_us_ += 300'001;
  tick();
  EXPECT_TRUE(std::isnan(sink_.newest().speed_m_s));
}

TEST_F(Gate, StaleLimitComesFromTheConfiguration) {
  CanConfig config;
  config.stale_s = 0.05;
  gate_ = CanGate(config);
  give(1);
  tick(6);
  EXPECT_EQ(sink_.newest().ego_validity, kValid) << "50 ms old is not older than 50 ms";
  tick();
  EXPECT_TRUE(std::isnan(sink_.newest().ego_validity));
}

TEST_F(Gate, EgoStatusDecidesTheValidity) {
  const std::map<CanEgoStatus, double> expected = {{CanEgoStatus::kOk, kValid},
                                                   {CanEgoStatus::kStandstill, kValid},
                                                   {CanEgoStatus::kScaleHeld, kDegraded},
                                                   {CanEgoStatus::kCoasting, kDegraded},
                                                   {CanEgoStatus::kInitializing, kInvalid},
                                                   {CanEgoStatus::kLost, kInvalid}};
  std::int64_t seq = 0;
  for (const auto& [status, validity] : expected) {
    ++seq;
    CanEgo ego = make_ego(seq, status);
    ego.reason = 4;
    ego.reset_counter = 2;
    gate_.on_ground_plane(make_plane(seq), now_us_);
    gate_.on_ego_motion(ego, now_us_);
    tick(10);
    const CanValues v = sink_.newest();
    SCOPED_TRACE(static_cast<int>(status));
    EXPECT_EQ(v.ego_validity, validity);
    EXPECT_EQ(v.ego_status, static_cast<double>(status));
    EXPECT_EQ(v.ego_reason, 4.0);
    EXPECT_EQ(v.reset_counter, 2.0);
    if (validity == kInvalid) {
      expect_all_ego_values_absent(v);
    } else {
      EXPECT_NEAR(v.speed_m_s, 12.5, 0.0025);
      EXPECT_NEAR(v.speed_std_m_s, 0.1, 0.01);
      EXPECT_EQ(v.standstill, status == CanEgoStatus::kStandstill ? 1.0 : 0.0);
    }
  }
}

TEST_F(Gate, PlaneStatusDecidesTheValidity) {
  const std::map<CanPlaneStatus, double> expected = {{CanPlaneStatus::kOk, kValid},
                                                     {CanPlaneStatus::kHeld, kDegraded},
                                                     {CanPlaneStatus::kInitializing, kInvalid},
                                                     {CanPlaneStatus::kInvalid, kInvalid}};
  std::int64_t seq = 0;
  for (const auto& [status, validity] : expected) {
    ++seq;
    CanPlane plane = make_plane(seq, status);
    plane.reason = 5;
    gate_.on_ground_plane(plane, now_us_);
    gate_.on_ego_motion(make_ego(seq), now_us_);
    tick(10);
    const CanValues v = sink_.newest();
    SCOPED_TRACE(static_cast<int>(status));
    EXPECT_EQ(v.plane_validity, validity);
    EXPECT_EQ(v.plane_status, static_cast<double>(status));
    EXPECT_EQ(v.plane_reason, 5.0);
    if (validity == kInvalid) {
      expect_all_plane_values_absent(v);
    } else {
      EXPECT_NEAR(v.height_m, 1.65, 0.0005);
      EXPECT_NEAR(v.height_std_m, 0.02, 0.00025);
    }
  }
}

TEST_F(Gate, AStatusThatHoldsWithValuesThatDoNotIsInvalid) {
  std::int64_t seq = 0;
  for (double CanEgo::*field : {&CanEgo::speed_m_s, &CanEgo::yaw_rate_rad_s}) {
    CanEgo ego = make_ego(++seq);
    ego.*field = kNan;
    gate_.on_ground_plane(make_plane(seq), now_us_);
    gate_.on_ego_motion(ego, now_us_);
    tick();
    EXPECT_EQ(sink_.newest().ego_validity, kInvalid);
    expect_all_ego_values_absent(sink_.newest());
  }
  for (double CanPlane::*field : {&CanPlane::pitch_rad, &CanPlane::roll_rad, &CanPlane::height_m}) {
    CanPlane plane = make_plane(++seq);
    plane.*field = std::numeric_limits<double>::infinity();
    gate_.on_ground_plane(plane, now_us_);
    gate_.on_ego_motion(make_ego(seq), now_us_);
    tick();
    EXPECT_EQ(sink_.newest().plane_validity, kInvalid);
    expect_all_plane_values_absent(sink_.newest());
  }
}

TEST_F(Gate, OneUnknownValueDoesNotSpoilTheOthers) {
  CanEgo ego = make_ego(1);
  ego.accel_m_s2 = kNan;
  gate_.on_ground_plane(make_plane(1), now_us_);
  gate_.on_ego_motion(ego, now_us_);
  tick();
  EXPECT_TRUE(std::isnan(sink_.newest().accel_m_s2));
  EXPECT_EQ(sink_.newest().ego_validity, kValid);
  EXPECT_NEAR(sink_.newest().speed_m_s, 12.5, 0.0025);
}

TEST_F(Gate, ModeTellsTheStateOfTheWholeChain) {
  struct Case {
    CanEgoStatus ego;
    CanPlaneStatus plane;
    CanMode mode;
  };
  std::int64_t seq = 0;
  for (const Case& c :
       {Case{CanEgoStatus::kOk, CanPlaneStatus::kOk, CanMode::kNormal},
        Case{CanEgoStatus::kCoasting, CanPlaneStatus::kOk, CanMode::kDegraded},
        Case{CanEgoStatus::kOk, CanPlaneStatus::kHeld, CanMode::kDegraded},
        Case{CanEgoStatus::kInitializing, CanPlaneStatus::kInitializing, CanMode::kInitializing},
        Case{CanEgoStatus::kOk, CanPlaneStatus::kInitializing, CanMode::kInitializing},
        Case{CanEgoStatus::kLost, CanPlaneStatus::kOk, CanMode::kFailed},
        Case{CanEgoStatus::kOk, CanPlaneStatus::kInvalid, CanMode::kFailed}}) {
    ++seq;
    gate_.on_ground_plane(make_plane(seq, c.plane), now_us_);
    gate_.on_ego_motion(make_ego(seq, c.ego), now_us_);
    tick(10);
    EXPECT_EQ(sink_.newest().mode, static_cast<double>(c.mode)) << "case " << seq;
  }
}

TEST_F(Gate, HalfAFrameWaitsForTheOtherHalfOnlySoLong) {
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

TEST_F(Gate, AHalfThatComesTooLateStillJoinsItsFrame) {
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

TEST_F(Gate, ALateHalfIsSentBeforeTheNextFrameTakesItsPlace) {
  gate_.on_ground_plane(make_plane(1), now_us_);
  tick(13);
  sink_.sent.clear();
  gate_.on_ego_motion(make_ego(1), now_us_);
  give(2);
  tick(2);
  EXPECT_EQ(frames_sent(), (std::vector<int>{1, 2}));
}

TEST_F(Gate, ALateHalfFindsItsFrameInTheQueue) {
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

TEST_F(Gate, TheNextFrameReleasesHalfAFrame) {
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

TEST_F(Gate, HalvesPairInEitherOrder) {
  gate_.on_ego_motion(make_ego(1), now_us_);
  gate_.on_ground_plane(make_plane(1), now_us_);
  tick();
  EXPECT_EQ(sink_.newest().ego_validity, kValid);
  EXPECT_EQ(sink_.newest().plane_validity, kValid);
  EXPECT_EQ(gate_.counters().num_unpaired, 0);
}

TEST_F(Gate, AFrozenSourceIsIgnoredAndBecomesStale) {
  give(1);
  for (int i = 0; i < 40; ++i) {
    give(1);
    tick();
  }
  EXPECT_EQ(gate_.counters().num_frames, 1);
  EXPECT_EQ(gate_.counters().num_repeated, 80);
  EXPECT_TRUE(std::isnan(sink_.newest().ego_validity));
}

TEST_F(Gate, TheSameHalfTwiceIsCountedAndTheFirstOneKept) {
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

TEST_F(Gate, MissingFramesAreCountedAndShown) {
  give(10);
  give(11);
  give(15);
  tick(20);
  EXPECT_EQ(gate_.counters().num_missed, 3);
  EXPECT_EQ(sink_.newest().num_missed, 3.0);
}

TEST_F(Gate, ARestartedSourceIsTakenUpAgain) {
  give(1000);
  give(0);
  tick(2);
  EXPECT_EQ(frames_sent(), (std::vector<int>{1000 % 256, 0}));
  EXPECT_EQ(gate_.counters().num_missed, 0);
}

TEST_F(Gate, WildSequenceNumbersDoNoHarm) {
  for (const std::int64_t seq :
       {std::int64_t{0}, INT64_MAX, std::int64_t{1}, INT64_MAX - 1, INT64_MIN}) {
    give(seq);
    tick();
  }
  EXPECT_EQ(gate_.counters().num_frames, 5);
}

TEST_F(Gate, CountersStayAtTheLargestValueInsteadOfWrapping) {
  give(0);
  give(300);
  gate_.report(1'000'000, 255);
  tick(10);
  const CanValues v = sink_.newest();
  EXPECT_EQ(v.num_missed, 254.0);
  EXPECT_EQ(v.num_rejected, 254.0);
  EXPECT_EQ(v.num_unsent, 254.0);
  EXPECT_EQ(v.num_overflowed, 0.0);
}

TEST_F(Gate, ResetCounterNeverSaysNotAvailable) {
  CanEgo ego = make_ego(1);
  ego.reset_counter = 255;
  gate_.on_ground_plane(make_plane(1), now_us_);
  gate_.on_ego_motion(ego, now_us_);
  tick();
  EXPECT_EQ(sink_.newest().reset_counter, 0.0);
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
  EXPECT_TRUE(std::isnan(sink_.newest().ego_validity));
}

TEST_F(Gate, ExtremeTimesDoNoHarm) {
  now_us_ = INT64_MIN;
  give(1);
  gate_.tick(now_us_, sink_);
  EXPECT_EQ(sink_.newest().ego_validity, kValid);
  gate_.tick(INT64_MAX, sink_);
  EXPECT_TRUE(std::isnan(sink_.all("PLB_EgoMotion").back().ego_validity));
  now_us_ = INT64_MAX;
  give(2);
  gate_.tick(now_us_, sink_);
  EXPECT_EQ(sink_.newest().ego_validity, kValid);
}

TEST_F(Gate, UptimeCountsFromTheFirstTickAndSaturates) {
  tick();
  EXPECT_EQ(sink_.newest().uptime_s, 0.0);
  tick(300);
  EXPECT_EQ(sink_.newest().uptime_s, 3.0);
  now_us_ += 100'000'000'000;
  tick(100);
  EXPECT_EQ(sink_.newest().uptime_s, 65534.0);
}

TEST_F(Gate, TheSameInputGivesTheSameFrames) {
  const auto run = [] {
    CanGate gate{CanConfig{}};
    test::RecordingSink sink;
    for (int i = 0; i < 200; ++i) {
      CanEgo ego = make_ego(i / 7);
      ego.speed_m_s = 0.1 * i;
      gate.on_ground_plane(make_plane(i / 7), i * 10'000);
      gate.on_ego_motion(ego, i * 10'000);
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
