#include "modules/can/can_wire.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numbers.hpp"
#include "tests/can/from_wire.hpp"
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
  m.capture_mono_us = m.utime;
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
  m.capture_mono_us = m.utime;
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
  m.status = ego_motion_t::STATUS_STANDSTILL;
  CanSample ego;
  ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
  EXPECT_TRUE(std::isnan(value_of(ego, "OdomDist_ScaleStd")));
  EXPECT_EQ(value_of(ego, "EgoMotion_Validity"), static_cast<double>(CanValidity::kValid));
  EXPECT_EQ(value_of(ego, "OdomX_Validity"), static_cast<double>(CanValidity::kDegraded));
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
    for (const double bad : {kInf, -kInf}) {
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

CanValidity validity_in(const CanSample& sample, const char* signal) {
  return static_cast<CanValidity>(value_of(sample, signal));
}

TEST(CanWire, ASpeedThatIsNotMeasuredIsNotAvailableAndThePoseStays) {
  for (const std::int8_t status :
       {ego_motion_t::STATUS_OK, ego_motion_t::STATUS_SCALE_HELD, ego_motion_t::STATUS_COASTING}) {
    for (double ego_motion_t::*std_m_s :
         {static_cast<double ego_motion_t::*>(nullptr), &ego_motion_t::speed_std_m_s}) {
      ego_motion_t m = make_ego();
      m.status = status;
      if (std_m_s == nullptr) {
        m.velocity_ground_m_s[0] = kNan;
      } else {
        m.*std_m_s = kNan;
      }
      CanSample ego;
      ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
      EXPECT_TRUE(std::isnan(value_of(ego, "EgoMotion_Speed")));
      EXPECT_TRUE(std::isnan(value_of(ego, "EgoMotion_SpeedStd")));
      EXPECT_TRUE(std::isnan(value_of(ego, "EgoMotion_YawRate"))) << "invalid as a whole";
      EXPECT_TRUE(std::isnan(value_of(ego, "EgoMotion_Standstill")));
      EXPECT_EQ(validity_in(ego, "EgoMotion_Validity"), CanValidity::kInvalid);
      EXPECT_EQ(value_of(ego, "OdomX_PosX"), 40.0);
      EXPECT_EQ(validity_in(ego, "OdomX_Validity"),
                status == ego_motion_t::STATUS_OK ? CanValidity::kValid : CanValidity::kDegraded);
      EXPECT_EQ(ego.validity, CanValidity::kInvalid);
      EXPECT_TRUE(ego.has_values);
    }
  }
}

TEST(CanWire, AYawRateThatIsNotMeasuredDegradesTheMotion) {
  ego_motion_t m = make_ego();
  for (double& rate : m.rate_ground_rad_s) rate = kNan;
  m.yaw_rate_std_rad_s = kNan;
  CanSample ego;
  ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
  EXPECT_TRUE(std::isnan(value_of(ego, "EgoMotion_YawRate")));
  EXPECT_EQ(value_of(ego, "EgoMotion_Speed"), 10.0);
  EXPECT_EQ(validity_in(ego, "EgoMotion_Validity"), CanValidity::kDegraded);
  EXPECT_EQ(validity_in(ego, "OdomX_Validity"), CanValidity::kValid);
}

TEST(CanWire, APoseThatIsNotKnownIsInvalidAndTheSpeedStays) {
  for (const int which : {0, 1, 2}) {
    ego_motion_t m = make_ego();
    if (which == 0) m.t_world_cam_m[1] = kNan;
    if (which == 1) m.q_world_cam[2] = kNan;
    if (which == 2) m.distance_m = kNan;
    CanSample ego;
    ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
    for (const char* const name : {"OdomX_PosX", "OdomX_Heading", "OdomY_PosY", "OdomY_PosZ",
                                   "OdomDist_Distance", "OdomDist_ScaleStd"}) {
      EXPECT_TRUE(std::isnan(value_of(ego, name))) << name;
    }
    for (const char* const name : {"OdomX_Validity", "OdomY_Validity", "OdomDist_Validity"})
      EXPECT_EQ(validity_in(ego, name), CanValidity::kInvalid) << name;
    EXPECT_EQ(value_of(ego, "EgoMotion_Speed"), 10.0);
    EXPECT_EQ(validity_in(ego, "EgoMotion_Validity"), CanValidity::kValid);
  }
}

TEST(CanWire, AValueOrDeviationBeyondItsRangeIsNeitherSentNorCalledValid) {
  ego_motion_t m = make_ego();
  m.speed_std_m_s = 5.2;  // the signal ends at 5.08
  CanSample ego;
  ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
  EXPECT_TRUE(std::isnan(value_of(ego, "EgoMotion_Speed")));
  EXPECT_EQ(validity_in(ego, "EgoMotion_Validity"), CanValidity::kInvalid);
  m = make_ego();
  m.velocity_ground_m_s[0] = 300.0;
  ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
  EXPECT_TRUE(std::isnan(value_of(ego, "EgoMotion_Speed")));
  EXPECT_EQ(validity_in(ego, "EgoMotion_Validity"), CanValidity::kInvalid);
  m = make_ego();
  m.yaw_rate_std_rad_s = 0.2;
  m.accel_forward_m_s2 = 127.0;
  m.log_scale_std = 0.6;
  ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
  EXPECT_TRUE(std::isnan(value_of(ego, "EgoMotion_YawRate")));
  EXPECT_TRUE(std::isnan(value_of(ego, "EgoDetail_AccelX")));
  EXPECT_TRUE(std::isnan(value_of(ego, "EgoDetail_AccelXStd")));
  EXPECT_EQ(validity_in(ego, "EgoMotion_Validity"), CanValidity::kDegraded);
  EXPECT_EQ(validity_in(ego, "OdomDist_Validity"), CanValidity::kDegraded);

  ground_plane_t p = make_plane();
  p.cov[0][0] = 1.0;
  CanSample plane;
  ASSERT_EQ(from_wire(p, default_messages(), &plane), nullptr);
  EXPECT_TRUE(std::isnan(value_of(plane, "GroundPlane_Pitch")));
  EXPECT_EQ(value_of(plane, "GroundPlane_Height"), 1.6);
  EXPECT_EQ(validity_in(plane, "GroundPlane_Validity"), CanValidity::kDegraded);
  for (int i = 0; i < 3; ++i) p.cov[i][i] = 1.0;
  ASSERT_EQ(from_wire(p, default_messages(), &plane), nullptr);
  EXPECT_EQ(validity_in(plane, "GroundPlane_Validity"), CanValidity::kInvalid);
}

TEST(CanWire, AStandstillThatOnlyEqualImagesTellIsDegraded) {
  ego_motion_t m = make_ego();
  m.status = ego_motion_t::STATUS_STANDSTILL;
  m.velocity_ground_m_s[0] = 0.0;
  CanSample ego;
  ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
  EXPECT_EQ(validity_in(ego, "EgoMotion_Validity"), CanValidity::kValid);
  m.reason = vo_motion_t::REASON_IMAGE_UNPROVEN;
  ASSERT_EQ(from_wire(m, default_messages(), &ego), nullptr);
  EXPECT_EQ(validity_in(ego, "EgoMotion_Validity"), CanValidity::kDegraded);
  EXPECT_EQ(validity_in(ego, "OdomX_Validity"), CanValidity::kDegraded);
  EXPECT_EQ(value_of(ego, "Status_EgoReason"), vo_motion_t::REASON_IMAGE_UNPROVEN);
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
  refuses_ego([](ego_motion_t& m) { m.reason = 63; });
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
  refuses_plane([](ground_plane_t& m) {
    m.num_cues = 9;
    m.cues.resize(9);
  });
  refuses_plane([](ground_plane_t& m) { m.height_m = 0.0; });
  refuses_plane([](ground_plane_t& m) { m.cov[1][1] = -1e-9; });
}

TEST(CanWire, TheEndsOfEveryRangeAreAccepted) {
  CanSample ego;
  CanSample plane;
  for (const std::int8_t reason : {std::int8_t{0}, std::int8_t{14}}) {
    ego_motion_t m = make_ego(0);
    m.reason = reason == 0 ? reason : std::int8_t{62};
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

}  // namespace
}  // namespace plumb
