// Tests when the gate calls values valid, degraded, invalid and not available.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/can/gate_fixture.hpp"

namespace plumb {
namespace {

using namespace test;  // NOLINT: the fixture and its samples

class GateValidity : public GateFixture {};

TEST_F(GateValidity, StaleValuesAreNotAvailableWithinOneCycle) {
  give(1);
  const std::int64_t limit_us = now_us_ + 250'000;
  while (now_us_ <= limit_us) {
    tick();
    ASSERT_EQ(sink_.newest()["EgoMotion_Validity"], kValid);
  }
  tick();  // the cycle of the motion and the plane
  EXPECT_TRUE(std::isnan(sink_.all("EgoMotion").back()["EgoMotion_Validity"]));
  EXPECT_TRUE(std::isnan(sink_.all("EgoMotion").back()["EgoMotion_Speed"]));
  EXPECT_TRUE(std::isnan(sink_.all("EgoMotionDetail").back()["EgoDetail_Status"]));
  EXPECT_TRUE(std::isnan(sink_.all("GroundPlane").back()["GroundPlane_Validity"]));
  EXPECT_TRUE(std::isnan(sink_.all("GroundPlane").back()["GroundPlane_Height"]));
  EXPECT_TRUE(std::isnan(sink_.all("GroundPlaneDetail").back()["GroundDetail_Status"]));
  EXPECT_TRUE(std::isnan(sink_.all("GroundPlaneDetail").back()["GroundDetail_CuesUsed"]));
  tick();  // the cycle of the odometry
  const Reading v = sink_.newest();
  expect_all_ego_values_absent(v);
  expect_all_plane_values_absent(v);
  EXPECT_TRUE(std::isnan(v["OdomDist_ResetCtr"]));
  EXPECT_EQ(v.frame_counter(), 1.0) << "still names the last frame";
  tick(10);
  EXPECT_EQ(sink_.newest()["Status_Mode"], static_cast<double>(CanMode::kNoInput));
}

TEST_F(GateValidity, RecoversWithTheFirstFrameAfterSilence) {
  give(1);
  tick(100);
  ASSERT_TRUE(std::isnan(sink_.newest()["EgoMotion_Speed"]));
  give(2);
  tick();
  EXPECT_EQ(sink_.newest()["EgoMotion_Validity"], kValid);
  EXPECT_EQ(sink_.newest().frame_counter(), 2.0);
}

TEST_F(GateValidity, AFrameThatWaitedTooLongIsSentAsNotAvailable) {
  give(1);
  now_us_ += 250'001;
  tick();
  EXPECT_TRUE(std::isnan(sink_.newest()["EgoMotion_Speed"]));
}

TEST_F(GateValidity, StaleLimitComesFromTheConfiguration) {
  CanConfig config;
  config.stale_s = 0.05;
  gate_ = CanGate(config, default_messages());
  give(1);
  tick(6);
  EXPECT_EQ(sink_.newest()["EgoMotion_Validity"], kValid) << "50 ms old is not older than 50 ms";
  tick();
  EXPECT_TRUE(std::isnan(sink_.newest()["EgoMotion_Validity"]));
}

TEST_F(GateValidity, EgoStatusDecidesTheValidity) {
  const std::map<std::int8_t, double> expected = {{ego_motion_t::STATUS_OK, kValid},
                                                  {ego_motion_t::STATUS_STANDSTILL, kValid},
                                                  {ego_motion_t::STATUS_SCALE_HELD, kDegraded},
                                                  {ego_motion_t::STATUS_COASTING, kDegraded},
                                                  {ego_motion_t::STATUS_INITIALIZING, kInvalid},
                                                  {ego_motion_t::STATUS_LOST, kInvalid}};
  std::int64_t seq = 0;
  for (const auto& [status, validity] : expected) {
    ++seq;
    ego_motion_t ego = make_ego(seq, status);
    ego.reason = 4;
    ego.reset_counter = 2;
    hear(make_plane(seq));
    hear(ego);
    tick(10);
    const Reading v = sink_.newest();
    SCOPED_TRACE(static_cast<int>(status));
    EXPECT_EQ(v["EgoMotion_Validity"], validity);
    EXPECT_EQ(v["EgoDetail_Status"], static_cast<double>(status));
    EXPECT_EQ(v["Status_EgoReason"], 4.0);
    EXPECT_EQ(v["OdomDist_ResetCtr"], 2.0);
    if (validity == kInvalid) {
      expect_all_ego_values_absent(v);
    } else {
      EXPECT_NEAR(v["EgoMotion_Speed"], 12.5, 0.0025);
      EXPECT_NEAR(v["EgoMotion_SpeedStd"], 0.1, 0.01);
      EXPECT_EQ(v["EgoMotion_Standstill"], status == ego_motion_t::STATUS_STANDSTILL ? 1.0 : 0.0);
    }
  }
}

TEST_F(GateValidity, PlaneStatusDecidesTheValidity) {
  const std::map<std::int8_t, double> expected = {{ground_plane_t::STATUS_OK, kValid},
                                                  {ground_plane_t::STATUS_HELD, kDegraded},
                                                  {ground_plane_t::STATUS_INITIALIZING, kInvalid},
                                                  {ground_plane_t::STATUS_INVALID, kInvalid}};
  std::int64_t seq = 0;
  for (const auto& [status, validity] : expected) {
    ++seq;
    ground_plane_t plane = make_plane(seq, status);
    plane.reason = 5;
    hear(plane);
    hear(make_ego(seq));
    tick(10);
    const Reading v = sink_.newest();
    SCOPED_TRACE(static_cast<int>(status));
    EXPECT_EQ(v["GroundPlane_Validity"], validity);
    EXPECT_EQ(v["GroundDetail_Status"], static_cast<double>(status));
    EXPECT_EQ(v["GroundDetail_Reason"], 5.0);
    if (validity == kInvalid) {
      expect_all_plane_values_absent(v);
    } else {
      EXPECT_NEAR(v["GroundPlane_Height"], 1.65, 0.0005);
      EXPECT_NEAR(v["GroundDetail_HeightStd"], 0.02, 0.00025);
    }
  }
}

TEST_F(GateValidity, OneUnknownValueDoesNotSpoilTheOthers) {
  ego_motion_t ego = make_ego(1);
  ego.accel_forward_m_s2 = kNan;
  hear(make_plane(1));
  hear(ego);
  tick();
  EXPECT_TRUE(std::isnan(sink_.newest()["EgoDetail_AccelX"]));
  EXPECT_EQ(sink_.newest()["EgoMotion_Validity"], kValid);
  EXPECT_NEAR(sink_.newest()["EgoMotion_Speed"], 12.5, 0.0025);
}

TEST_F(GateValidity, ModeTellsTheStateOfTheWholeChain) {
  struct Case {
    std::int8_t ego;
    std::int8_t plane;
    CanMode mode;
  };
  std::int64_t seq = 0;
  for (const Case& c :
       {Case{ego_motion_t::STATUS_OK, ground_plane_t::STATUS_OK, CanMode::kNormal},
        Case{ego_motion_t::STATUS_COASTING, ground_plane_t::STATUS_OK, CanMode::kDegraded},
        Case{ego_motion_t::STATUS_OK, ground_plane_t::STATUS_HELD, CanMode::kDegraded},
        Case{ego_motion_t::STATUS_INITIALIZING, ground_plane_t::STATUS_INITIALIZING,
             CanMode::kInitializing},
        Case{ego_motion_t::STATUS_OK, ground_plane_t::STATUS_INITIALIZING, CanMode::kInitializing},
        Case{ego_motion_t::STATUS_LOST, ground_plane_t::STATUS_OK, CanMode::kFailed},
        Case{ego_motion_t::STATUS_OK, ground_plane_t::STATUS_INVALID, CanMode::kFailed}}) {
    ++seq;
    hear(make_plane(seq, c.plane));
    hear(make_ego(seq, c.ego));
    tick(10);
    EXPECT_EQ(sink_.newest()["Status_Mode"], static_cast<double>(c.mode)) << "case " << seq;
  }
}

}  // namespace
}  // namespace plumb
