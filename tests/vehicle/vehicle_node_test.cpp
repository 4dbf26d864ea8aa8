#include "modules/vehicle/vehicle_node.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

class VehicleNodeTest : public testing::Test {
 protected:
  VehicleNodeTest() {
    signal_.id = 0x123;
    signal_.num_bits = 16;
    signal_.factor = 0.01;
    signal_.max = 100.0;
    config_.delay_s = 0.02;
    config_.scale_std = 0.015;
  }

  static CanFrame frame(unsigned id, unsigned hundredths) {
    CanFrame f;
    f.id = id;
    f.size = 2;
    f.data[0] = static_cast<std::uint8_t>(hundredths & 0xFFU);
    f.data[1] = static_cast<std::uint8_t>(hundredths >> 8U);
    return f;
  }
  static ego_motion_t ego(std::int64_t utime, std::int64_t mono_us) {
    ego_motion_t message{};
    message.utime = utime;
    message.capture_mono_us = mono_us;
    return message;
  }

  DbcSignal signal_;
  VehicleSpeedConfig config_;
};

TEST_F(VehicleNodeTest, StampsTheSpeedOnTheClockOfTheCamera) {
  VehicleNode node(config_, signal_, 77);
  EXPECT_EQ(node.take_frame(frame(0x123, 2000), 5'000'000), nullptr) << "no clock yet";
  EXPECT_FALSE(node.has_clock());
  node.take_ego(ego(1'700'000'000'000'000, 5'000'000));
  const vehicle_speed_t* message = node.take_frame(frame(0x123, 2000), 5'100'000);
  ASSERT_NE(message, nullptr);
  EXPECT_EQ(message->utime, 1'700'000'000'080'000) << "0.1 s after the image, less the delay";
  EXPECT_DOUBLE_EQ(message->speed_m_s, 20.0);
  EXPECT_EQ(message->scale_std, 0.015);
  EXPECT_EQ(message->session, 77);
}

TEST_F(VehicleNodeTest, KeepsItsClockWhenAMotionStatesNone) {
  VehicleNode node(config_, signal_, 0);
  node.take_ego(ego(1'000, 5'000'000));
  node.take_ego(ego(200'000, 0));
  EXPECT_EQ(node.take_frame(frame(0x123, 1), 5'020'000)->utime, 1'000);
}

TEST_F(VehicleNodeTest, TimesIncreaseAlthoughTheClockIsCorrected) {
  VehicleNode node(config_, signal_, 0);
  node.take_ego(ego(1'000'000, 5'000'000));
  ASSERT_NE(node.take_frame(frame(0x123, 1), 5'100'000), nullptr);
  EXPECT_EQ(node.take_frame(frame(0x123, 1), 5'100'000), nullptr) << "two frames read at once";
  node.take_ego(ego(1'100'000, 5'115'000));  // 15 ms later than thought
  EXPECT_EQ(node.take_frame(frame(0x123, 1), 5'110'000), nullptr);
  EXPECT_EQ(node.take_frame(frame(0x123, 1), 5'120'000)->utime, 1'085'000);
  node.take_ego(ego(0, 5'200'000));  // the camera's clock begins anew
  EXPECT_EQ(node.take_frame(frame(0x123, 1), 5'220'000)->utime, 0);
}

TEST_F(VehicleNodeTest, CountsFramesWithoutASpeedAndIgnoresOthers) {
  VehicleNode node(config_, signal_, 0);
  node.take_ego(ego(1'000, 5'000'000));
  EXPECT_EQ(node.take_frame(frame(0x124, 2000), 5'100'000), nullptr);
  EXPECT_EQ(node.num_unknown(), 0);
  EXPECT_EQ(node.take_frame(frame(0x123, 0xFFFF), 5'100'000), nullptr);
  EXPECT_EQ(node.num_unknown(), 1);
}

}  // namespace
}  // namespace plumb
