// When the gate calls values valid, degraded, invalid and not available.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "tests/can/gate_fixture.hpp"

namespace plumb {
namespace {

using namespace test;  // NOLINT: the fixture and its samples

class GateValidity : public GateFixture {};

TEST_F(GateValidity, StaleValuesAreNotAvailableWithinOneCycle) {
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

TEST_F(GateValidity, RecoversWithTheFirstFrameAfterSilence) {
  give(1);
  tick(100);
  ASSERT_TRUE(std::isnan(sink_.newest().speed_m_s));
  give(2);
  tick();
  EXPECT_EQ(sink_.newest().ego_validity, kValid);
  EXPECT_EQ(sink_.newest().frame_counter, 2.0);
}

TEST_F(GateValidity, AFrameThatWaitedTooLongIsSentAsNotAvailable) {
  give(1);
  now_us_ += 300'001;
  tick();
  EXPECT_TRUE(std::isnan(sink_.newest().speed_m_s));
}

TEST_F(GateValidity, StaleLimitComesFromTheConfiguration) {
  CanConfig config;
  config.stale_s = 0.05;
  gate_ = CanGate(config);
  give(1);
  tick(6);
  EXPECT_EQ(sink_.newest().ego_validity, kValid) << "50 ms old is not older than 50 ms";
  tick();
  EXPECT_TRUE(std::isnan(sink_.newest().ego_validity));
}

TEST_F(GateValidity, EgoStatusDecidesTheValidity) {
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

TEST_F(GateValidity, PlaneStatusDecidesTheValidity) {
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

TEST_F(GateValidity, AStatusThatHoldsWithValuesThatDoNotIsInvalid) {
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

TEST_F(GateValidity, OneUnknownValueDoesNotSpoilTheOthers) {
  CanEgo ego = make_ego(1);
  ego.accel_m_s2 = kNan;
  gate_.on_ground_plane(make_plane(1), now_us_);
  gate_.on_ego_motion(ego, now_us_);
  tick();
  EXPECT_TRUE(std::isnan(sink_.newest().accel_m_s2));
  EXPECT_EQ(sink_.newest().ego_validity, kValid);
  EXPECT_NEAR(sink_.newest().speed_m_s, 12.5, 0.0025);
}

TEST_F(GateValidity, ModeTellsTheStateOfTheWholeChain) {
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

}  // namespace
}  // namespace plumb
