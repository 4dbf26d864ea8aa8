#include "modules/vo/road/road_motion.hpp"

#include <gtest/gtest.h>

#include "modules/vo/road/road_odometry.hpp"
#include "tests/ground/road_scene.hpp"

namespace plumb::vo {
namespace {

constexpr double kInterval_s = 0.1;
constexpr int kNumImages = 16;

/// A car on a textured road, seen by a camera that may have something attached to it.
class RoadMotionTest : public ::testing::Test {
 protected:
  explicit RoadMotionTest(double step_m = 2.2) {
    drive_.step_m = step_m;
    poses_ = drive_.poses(kNumImages);
  }

  /// [1/s] The true speed in heights of the camera.
  [[nodiscard]] double true_speed() const {
    return drive_.step_m / kInterval_s / plumb::test::kRoadHeight;
  }
  [[nodiscard]] plumb::test::GreyImage image(int k) const {
    return plumb::test::render(camera_, poses_[static_cast<std::size_t>(k)], shutter_, 7U);
  }
  [[nodiscard]] VoOutput vo(int k) const {
    VoOutput out;
    plumb::test::script_vo(poses_, k, script_, &out);
    return out;
  }

  CameraModel camera_ = plumb::test::scene_camera();
  plumb::test::Drive drive_;
  plumb::test::Shutter shutter_;
  plumb::test::VoScript script_;
  std::vector<Se3> poses_;
};

TEST_F(RoadMotionTest, MeasuresTheSpeedInHeightsOfTheCamera) {
  RoadMotion motion(camera_);
  for (int k = 1; k < kNumImages; ++k) motion.take(image(k).view(), vo(k), true, kInterval_s);
  const RoadSpeedEstimate road = motion.estimate();
  ASSERT_TRUE(road.sure);
  EXPECT_NEAR(road.speed / true_speed(), 1.0, 0.05);
  EXPECT_LT(road.speed_std, 0.1 * road.speed);
}

TEST_F(RoadMotionTest, MeasuresADarkRoadAsWell) {
  shutter_.gain = 0.1;
  shutter_.noise_grey = 1.0;
  RoadMotion motion(camera_);
  for (int k = 1; k < kNumImages; ++k) motion.take(image(k).view(), vo(k), true, kInterval_s);
  ASSERT_TRUE(motion.estimate().sure);
  EXPECT_NEAR(motion.estimate().speed / true_speed(), 1.0, 0.05);
}

TEST_F(RoadMotionTest, IsNotSureOfTheSameImageAgainAndAgain) {
  RoadMotion motion(camera_);
  const plumb::test::GreyImage still = image(0);
  for (int k = 1; k < 40; ++k) {
    motion.take(still.view(), VoOutput{}, true, kInterval_s);
    EXPECT_FALSE(motion.estimate().sure) << k;
  }
}

TEST_F(RoadMotionTest, ForgetsTheSpeedWhileNoImageComes) {
  RoadMotion motion(camera_);
  for (int k = 1; k < kNumImages; ++k) motion.take(image(k).view(), vo(k), true, kInterval_s);
  ASSERT_TRUE(motion.estimate().sure);
  for (int k = 0; k < 50; ++k) motion.miss(kInterval_s);
  EXPECT_FALSE(motion.estimate().sure);
}

TEST_F(RoadMotionTest, TheOdometryReplacesAStandstillWhileTheRoadPasses) {
  RoadOdometry odometry(camera_);
  VoOutput out;
  for (int k = 1; k < kNumImages; ++k) {
    out = vo(k);
    if (k > 6) {  // a lorry ahead fills the picture
      out.status = VoStatus::kStandstill;
      out.T_prev_cam = Se3{};
      out.window.clear();
    }
    odometry.update(image(k).view(), true, kInterval_s, &out);
  }
  EXPECT_EQ(out.status, VoStatus::kOk);
  EXPECT_EQ(out.reason, VoReason::kRoadMotion);
  EXPECT_EQ(out.scale_epoch, 1);
  EXPECT_TRUE(out.road_points.empty());
  const double heights = out.T_prev_cam.t.norm() / out.road_height;
  EXPECT_NEAR(heights / (true_speed() * kInterval_s), 1.0, 0.1);
  ASSERT_GT(out.window.size(), 2U);
  EXPECT_EQ(out.window[0].seq, out.seq);
  EXPECT_EQ(out.window[1].seq, out.seq - 1);
  EXPECT_NEAR(out.window[1].T_window_cam.t.norm(), out.T_prev_cam.t.norm(), 1e-9);
}

TEST_F(RoadMotionTest, TheOdometryKeepsTheReasonOfAnImageThatCannotBeUsed) {
  RoadOdometry odometry(camera_);
  VoOutput out;
  for (int k = 1; k < kNumImages; ++k) {
    const bool is_last = k == kNumImages - 1;
    out = vo(k);
    if (k > 6) {
      out.status = is_last ? VoStatus::kCoasting : VoStatus::kStandstill;
      out.reason = is_last ? VoReason::kImageDark : VoReason::kNone;
      out.T_prev_cam = Se3{};
    }
    odometry.update(image(k).view(), !is_last, kInterval_s, &out);
  }
  EXPECT_EQ(out.status, VoStatus::kCoasting);
  EXPECT_EQ(out.reason, VoReason::kImageDark);
  EXPECT_GT(out.T_prev_cam.t.norm(), 0.0) << "the road's speed goes on";
}

TEST_F(RoadMotionTest, TheOdometryLeavesASoundMotionAsItIsAndStatesTheHeight) {
  RoadOdometry odometry(camera_);
  VoOutput out;
  for (int k = 1; k < kNumImages; ++k) {
    out = vo(k);
    odometry.update(image(k).view(), true, kInterval_s, &out);
  }
  EXPECT_EQ(out.reason, VoReason::kNone);
  EXPECT_EQ(out.scale_epoch, 0);
  EXPECT_TRUE(out.T_prev_cam.t == vo(kNumImages - 1).T_prev_cam.t);
  EXPECT_NEAR(out.road_height * script_.metres_per_vo / plumb::test::kRoadHeight, 1.0, 0.06);
  EXPECT_GT(out.road_height_std, 0.0);
}

}  // namespace
}  // namespace plumb::vo
