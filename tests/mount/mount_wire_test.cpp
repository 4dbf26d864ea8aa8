#include "modules/mount/mount_wire.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

TEST(MountWire, AMountWithoutAReferenceSaysSo) {
  MountReport report;
  report.status = MountStatus::kUnsteady;
  report.reason = MountReason::kTurning;
  report.progress = 0.75;
  report.num_stretches = 6;
  report.recent_rad = {0.01, 0.02, 0.03};
  report.spread_rad.setConstant(kNan);
  mount_t message;
  to_wire(report, 123, &message);
  EXPECT_EQ(message.utime, 123);
  EXPECT_EQ(message.status, mount_t::STATUS_UNSTEADY);
  EXPECT_EQ(message.reason, mount_t::REASON_TURNING);
  EXPECT_EQ(message.progress, 0.75);
  EXPECT_EQ(message.num_stretches, 6);
  EXPECT_EQ(message.recent_rad[2], 0.03);
  EXPECT_TRUE(std::isnan(message.reference_rad[0]));
  EXPECT_TRUE(std::isnan(message.reference_std_rad[1]));
  report.reference = {{-0.1, 0.2, 0.3}, {0.001, 0.002, 0.003}, 10};
  to_wire(report, 124, &message);
  EXPECT_EQ(message.reference_rad[1], 0.2);
  EXPECT_EQ(message.reference_std_rad[2], 0.003);
}

TEST(MountWire, WritesTheHeight) {
  HeightReport report;
  mount_t message;
  to_wire(report, &message);
  EXPECT_EQ(message.height_status, mount_t::HEIGHT_STATED);
  EXPECT_TRUE(std::isnan(message.vehicle_height_m));
  report.status = HeightStatus::kContradicted;
  report.num_stretches = 12;
  report.by_vehicle = {1.5, 0.02};
  report.used = {1.6, 0.05};
  to_wire(report, &message);
  EXPECT_EQ(message.height_status, mount_t::HEIGHT_CONTRADICTED);
  EXPECT_EQ(message.height_num_stretches, 12);
  EXPECT_EQ(message.vehicle_height_m, 1.5);
  EXPECT_EQ(message.vehicle_height_std_m, 0.02);
  EXPECT_EQ(message.height_m, 1.6);
  EXPECT_EQ(message.height_std_m, 0.05);
}

TEST(MountWire, RefusesASpeedThatCannotBe) {
  vehicle_speed_t message{};
  VehicleSpeed speed;
  message.utime = 5;
  message.speed_m_s = 20.0;
  message.scale_std = 0.01;
  ASSERT_EQ(from_wire(message, &speed), nullptr);
  EXPECT_EQ(speed.time_us, 5);
  EXPECT_EQ(speed.speed_m_s, 20.0);
  EXPECT_EQ(speed.scale_std, 0.01);
  message.speed_m_s = kNan;
  EXPECT_STREQ(from_wire(message, &speed), "vehicle speed is out of range");
  message.speed_m_s = -151.0;
  EXPECT_STREQ(from_wire(message, &speed), "vehicle speed is out of range");
  message.speed_m_s = 20.0;
  message.scale_std = -0.01;
  EXPECT_STREQ(from_wire(message, &speed), "deviation of the vehicle speed is not in [0, 1]");
  message.scale_std = 0.01;
  message.utime = -1;
  EXPECT_STREQ(from_wire(message, &speed), "vehicle speed has a negative time");
}

}  // namespace
}  // namespace plumb
