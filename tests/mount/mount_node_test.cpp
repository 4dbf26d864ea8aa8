#include "modules/mount/mount_node.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/numbers.hpp"
#include "tests/ground/straight_drive.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

class MountNodeTest : public testing::Test {
 protected:
  MountNodeTest() { config_.state_file = (folder_.path() / "mount.toml").string(); }

  /// Drives at ten images a second, keeps the last message and returns the number of messages.
  int drive(MountNode* node, double distance_m, double yaw_deg) {
    int num_messages = 0;
    GroundOutput output = test::straight_on({0.0, 0.0, yaw_deg * kDegree});
    for (double m = 0.0; m < distance_m; m += 0.1 * test::kSpeed_m_s) {
      output.capture_us = now_us_ += 100'000;
      const mount_t* message = node->update(output, {1.65, 0.01}, 1);
      if (message == nullptr) continue;
      ++num_messages;
      last_ = *message;
    }
    return num_messages;
  }

  test::TempFolder folder_;
  MountConfig config_;
  std::int64_t now_us_ = 1'000'000'000;
  mount_t last_{};
};

TEST_F(MountNodeTest, SpeaksOnceASecondAndAtOnceWhenTheStatusChanges) {
  MountNode node(config_);
  EXPECT_EQ(drive(&node, 400.0, 0.5), 40);
  EXPECT_EQ(last_.status, mount_t::STATUS_COLLECTING);
  drive(&node, 115.0, 0.5);
  EXPECT_EQ(last_.status, mount_t::STATUS_STEADY);
  EXPECT_EQ(node.alarm(), nullptr);
  drive(&node, 90.0, 3.5);
  EXPECT_EQ(last_.status, mount_t::STATUS_MOVED);
  EXPECT_STREQ(node.alarm(),
               "the camera has moved on its mount: pitch +0.0, roll +0.0, yaw +1.3 deg")
      << "half of the newest four stretches are old when the angle exceeds a degree";
  drive(&node, 160.0, 3.5);
  EXPECT_STREQ(node.alarm(),
               "the camera has moved on its mount: pitch +0.0, roll +0.0, yaw +3.0 deg")
      << "the sentence follows the measurement";
  drive(&node, 250.0, 0.5);
  EXPECT_EQ(node.alarm(), nullptr);
}

TEST_F(MountNodeTest, FollowsOneSenderOfTheVehicleSpeed) {
  MountNode node(config_);
  const auto take = [&](std::int64_t utime, std::int64_t session) {
    vehicle_speed_t message{};
    message.utime = utime;
    message.session = session;
    return node.take_speed(message);
  };
  EXPECT_EQ(take(100'000, 7), nullptr);
  EXPECT_STREQ(take(150'000, 6), "vehicle speed comes from a second sender");
  EXPECT_EQ(take(200'000, 7), nullptr);
  EXPECT_EQ(take(300'000, 8), nullptr) << "it was restarted";
}

TEST_F(MountNodeTest, WhatIsLearnedOfTheHeightBelongsToOneCamera) {
  MountNode node(config_);
  GroundOutput output = test::straight_on({0.0, 0.0, 0.0});
  output.ego.road_step_heights = 0.1 * test::kSpeed_m_s / 1.4;
  output.ego.road_step_ln_var = 1e-4;
  output.ego.rate_ground_rad_s.setZero();
  const auto drive_seconds = [&](int seconds, int camera) {
    for (int i = 0; i < 10 * seconds; ++i) {
      output.capture_us = now_us_ += 100'000;
      vehicle_speed_t speed{};
      speed.utime = now_us_;
      speed.session = 7;
      speed.speed_m_s = test::kSpeed_m_s;
      EXPECT_EQ(node.take_speed(speed), nullptr);
      node.update(output, {1.65, 0.4}, camera);
    }
  };
  drive_seconds(30, 1);
  ASSERT_NE(node.better_height(), nullptr);
  EXPECT_NEAR(node.height_report().by_vehicle.height_m, 1.4, 0.01);
  drive_seconds(1, 2);
  EXPECT_EQ(node.better_height(), nullptr) << "another camera sits where it is stated to";
}

TEST_F(MountNodeTest, AClockThatStepsBackDoesNotSilenceIt) {
  MountNode node(config_);
  drive(&node, 50.0, 0.5);
  now_us_ -= 900'000'000;
  EXPECT_EQ(drive(&node, 50.0, 0.5), 5);
}

TEST_F(MountNodeTest, TheReferenceSurvivesARestart) {
  {
    MountNode node(config_);
    drive(&node, 520.0, 0.5);
  }
  MountNode again(config_);
  drive(&again, 10.0, 0.5);
  EXPECT_EQ(last_.status, mount_t::STATUS_STEADY);
  EXPECT_NEAR(last_.reference_rad[2], 0.5 * kDegree, 1e-9);
}

TEST_F(MountNodeTest, ADamagedFileIsReplacedByTheNextReference) {
  std::ofstream(config_.state_file) << "garbage";
  MountNode node(config_);
  drive(&node, 10.0, 0.5);
  EXPECT_EQ(last_.status, mount_t::STATUS_COLLECTING);
  drive(&node, 520.0, 0.5);
  MountNode again(config_);
  drive(&again, 10.0, 0.5);
  EXPECT_EQ(last_.status, mount_t::STATUS_STEADY);
}

TEST_F(MountNodeTest, WithoutAFileItWritesNone) {
  config_.state_file.clear();
  MountNode node(config_);
  drive(&node, 520.0, 0.5);
  EXPECT_EQ(last_.status, mount_t::STATUS_STEADY);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(MountNodeTest, SaysHowFarTheCameraLooksOffTheDirectionOfTravel) {
  MountNode node(config_);
  drive(&node, 210.0, 12.0);
  EXPECT_EQ(last_.status, mount_t::STATUS_MISALIGNED);
  EXPECT_STREQ(node.alarm(),
               "the camera looks far off the direction of travel: +0.0 deg down, +12.0 deg left");
  drive(&node, 250.0, 0.5);
  EXPECT_EQ(node.alarm(), nullptr);
}

}  // namespace
}  // namespace plumb
