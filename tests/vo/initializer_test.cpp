#include "modules/vo/initializer.hpp"

#include <gtest/gtest.h>

#include "tests/vo/map_fixture.hpp"

namespace plumb::vo {
namespace {

using test::MapFixture;

TEST(Initializer, TheFirstImageIsTheReference) {
  MapFixture fixture;
  EXPECT_FALSE(fixture.initializer.has_reference());
  fixture.initialize(Se3{});
  EXPECT_TRUE(fixture.initializer.has_reference());
  EXPECT_FALSE(fixture.initializer.done());
  EXPECT_EQ(fixture.out.status, VoStatus::kInitializing);
  EXPECT_EQ(fixture.out.reason, VoReason::kFirstFrame);
  EXPECT_GT(fixture.out.num_new, 100);
}

TEST(Initializer, ForwardMotionGivesTheDirectionAndDepths) {
  MapFixture fixture;
  ASSERT_GT(fixture.drive_until_done(0.9), 0);
  EXPECT_EQ(fixture.out.status, VoStatus::kOk);
  EXPECT_EQ(fixture.out.scale_epoch, 0);
  const Window& window = fixture.map.window;
  const Se3 T_ref_now =
      window[window.order()[0]].T_cam_world * window[window.newest()].T_cam_world.inverse();
  EXPECT_GT(T_ref_now.t.normalized().z(), 0.999);
  EXPECT_LT(log_so3(T_ref_now.R).norm(), 0.005);
  EXPECT_TRUE(fixture.motion.known());
}

TEST(Initializer, WaitsWhileTheParallaxIsLow) {
  MapFixture fixture;
  fixture.initialize(Se3{});
  fixture.initialize({Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.06}});
  EXPECT_FALSE(fixture.initializer.done());
  EXPECT_EQ(fixture.out.status, VoStatus::kInitializing);
}

TEST(Initializer, ACameraThatStandsIsAtStandstill) {
  MapFixture fixture;
  for (int i = 0; i < 8; ++i) {
    fixture.initialize(Se3{});
    // One picture may have come several times.
    EXPECT_EQ(fixture.out.status, i < 5 ? VoStatus::kInitializing : VoStatus::kStandstill) << i;
  }
  EXPECT_FALSE(fixture.initializer.done());
}

TEST(Initializer, ATurnOnTheSpotGivesNoDepth) {
  MapFixture fixture;
  for (int i = 0; i < 6; ++i)
    fixture.initialize({exp_so3({0.0, 0.01 * i, 0.0}), Eigen::Vector3d::Zero()});
  EXPECT_FALSE(fixture.initializer.done());
}

TEST(Initializer, ARestartBeginsANewEpochAndCarriesTheSpeed) {
  MapFixture fixture;
  const int num = fixture.drive_until_done(0.9);
  ASSERT_GT(num, 0);
  fixture.show({Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.9 * num}});
  fixture.initializer.restart(fixture.time, fixture.map, fixture.motion, &fixture.out,
                              fixture.probe);
  EXPECT_EQ(fixture.out.status, VoStatus::kOk);
  EXPECT_EQ(fixture.out.reason, VoReason::kRestarted);
  EXPECT_EQ(fixture.out.scale_epoch, 1);
  EXPECT_GT(fixture.out.scale_carry_std, 0.0);
}

TEST(Initializer, ARestartWithoutAnyViewPredictsTheMotion) {
  MapFixture fixture;
  const int num = fixture.drive_until_done(0.9);
  ASSERT_GT(num, 0);
  fixture.show({exp_so3({0.0, 1.5, 0.0}), {0.0, 0.0, 0.9 * num}});  // nothing of before is in view
  fixture.initializer.restart(fixture.time, fixture.map, fixture.motion, &fixture.out,
                              fixture.probe);
  EXPECT_FALSE(fixture.initializer.done());
  EXPECT_EQ(fixture.out.status, VoStatus::kCoasting);
  EXPECT_GT(fixture.out.cov_prev_cam(2, 2), 0.0);
}

}  // namespace
}  // namespace plumb::vo
