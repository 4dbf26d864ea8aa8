#include "modules/vo/zero_motion_detector.hpp"

#include <gtest/gtest.h>

#include "tests/vo/map_fixture.hpp"

namespace plumb::vo {
namespace {

using test::MapFixture;

class ZeroMotionDetectorTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_GT(fixture_.drive_until_done(0.9), 0); }

  /// The pose that lies `step` from the newest one, in the camera's own axes.
  [[nodiscard]] Se3 moved_by(const Se3& step) const {
    return (fixture_.map.last_pose().inverse() * step).inverse();
  }

  MapFixture fixture_;
  ZeroMotionDetector detector_{MapFixture::config(), test::scene_camera()};
};

TEST_F(ZeroMotionDetectorTest, TheSamePoseStands) {
  EXPECT_EQ(detector_.judge(fixture_.map, moved_by(Se3{})), ZeroMotion::kAll);
}

TEST_F(ZeroMotionDetectorTest, AStepForwardMoves) {
  EXPECT_EQ(detector_.judge(fixture_.map, moved_by({Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.5}})),
            ZeroMotion::kNone);
}

TEST_F(ZeroMotionDetectorTest, ATurnOnTheSpotIsNoTranslation) {
  const Se3 turned = moved_by({exp_so3({0.0, 0.02, 0.0}), Eigen::Vector3d::Zero()});
  ASSERT_EQ(detector_.judge(fixture_.map, turned), ZeroMotion::kTranslation);
  const Se3 held = detector_.hold(fixture_.map, turned, ZeroMotion::kTranslation);
  const Eigen::Vector3d centre = held.inverse().t;
  EXPECT_LT((centre - fixture_.map.last_pose().inverse().t).norm(), 1e-9);
}

TEST_F(ZeroMotionDetectorTest, CreepingAddsUpUntilItIsSeen) {
  double crept = 0.0;
  ZeroMotion kind = ZeroMotion::kAll;
  for (int i = 0; i < 400 && kind == ZeroMotion::kAll; ++i) {
    crept += 0.001;
    kind =
        detector_.judge(fixture_.map, moved_by({Eigen::Matrix3d::Identity(), {0.0, 0.0, crept}}));
  }
  EXPECT_EQ(kind, ZeroMotion::kNone);
  EXPECT_GT(crept, 0.002) << "a single step must be too small to see";
}

TEST_F(ZeroMotionDetectorTest, APredictedPoseIsNoReference) {
  fixture_.map.window.remember(99, fixture_.map.last_pose(), false);
  EXPECT_EQ(detector_.judge(fixture_.map, moved_by(Se3{})), ZeroMotion::kNone);
}

}  // namespace
}  // namespace plumb::vo
