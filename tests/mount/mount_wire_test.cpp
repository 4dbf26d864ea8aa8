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

}  // namespace
}  // namespace plumb
