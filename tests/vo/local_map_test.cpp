#include "modules/vo/local_map.hpp"

#include <gtest/gtest.h>

#include "tests/vo/map_fixture.hpp"

namespace plumb::vo {
namespace {

using test::MapFixture;

constexpr double kStepM = 0.9;

/// A map that has been initialised on a straight drive.
class LocalMapTest : public ::testing::Test {
 protected:
  void SetUp() override {
    num_images_ = fixture_.drive_until_done(kStepM);
    ASSERT_GT(num_images_, 0);
  }
  [[nodiscard]] LocalMap& map() { return fixture_.map; }

  /// Shows the next image of the drive and searches the tracks in it. Returns its pose.
  Se3 track_next() {
    fixture_.show({Eigen::Matrix3d::Identity(), {0.0, 0.0, kStepM * num_images_}});
    const Se3 T_predicted = fixture_.motion.predict(0.1).inverse() * map().last_pose();
    map().tracker.begin(map().tracks, 0.1);
    map().tracker.predict_by_pose(map().tracks, map().window, map().last_image_pose(), T_predicted);
    map().tracker.search(map().last_image(), map().newest_image(), map().tracks, false);
    map().tracker.drop_missing(map().tracks);
    return map().fit(T_predicted, 8).T_cam_world;
  }

  MapFixture fixture_;
  int num_images_ = 0;
};

TEST_F(LocalMapTest, TheNewestImageBecomesTheLastOne) {
  const Pyramid* newest = &map().newest_image();
  const Pyramid* last = &map().last_image();
  ASSERT_NE(newest, last);
  map().keep_image(map().last_pose());
  EXPECT_EQ(&map().last_image(), newest);
  EXPECT_EQ(&map().newest_image(), last);
}

TEST_F(LocalMapTest, TheLastImagesPoseFollowsRefinements) {
  const Se3 offset{exp_so3({0.0, 0.01, 0.0}), {0.0, 0.0, -0.3}};
  map().keep_image(offset * map().last_pose());
  Frame& frame = map().window[map().window.newest()];
  frame.T_cam_world.t += Eigen::Vector3d(0.2, 0.0, 0.1);
  const Se3 expected = offset * frame.T_cam_world;
  EXPECT_LT((map().last_image_pose().t - expected.t).norm(), 1e-12);
}

TEST_F(LocalMapTest, AFittedPoseMovesByTheMotion) {
  const Se3 T_prev_cam = map().last_pose() * track_next().inverse();
  const double step = fixture_.motion.measured_speed() * 0.1;
  EXPECT_NEAR(T_prev_cam.t.z() / step, 1.0, 0.05);
  EXPECT_LT(T_prev_cam.t.head<2>().norm(), 0.03 * step);
}

TEST_F(LocalMapTest, AFrameWithoutRefinementBecomesAKeyframe) {
  const Se3 T_cam_world = track_next();
  NullProbe probe;
  const Insertion done = map().insert(num_images_, T_cam_world, false, probe);
  EXPECT_TRUE(done.is_keyframe);
  EXPECT_TRUE(map().window[map().window.newest()].is_keyframe());
  EXPECT_EQ(map().window[map().window.newest()].T_cam_world.t, T_cam_world.t) << "nothing refines";
}

TEST_F(LocalMapTest, AFrameWithRefinementIsAKeyframeOnlyWhenNeeded) {
  const Se3 T_cam_world = track_next();
  NullProbe probe;
  const Insertion done = map().insert(num_images_, T_cam_world, true, probe);
  EXPECT_GT(done.median_parallax_px, 0.5);
  EXPECT_LT(done.median_parallax_px, MapFixture::config().keyframe_parallax_px);
  EXPECT_FALSE(done.is_keyframe);
  EXPECT_EQ(done.num_new, 0);
  EXPECT_NE(map().window[map().window.newest()].T_cam_world.t, T_cam_world.t) << "it is refined";
}

TEST_F(LocalMapTest, AGrossOutlierIsRetiredWithoutItsObservation) {
  const Se3 T_cam_world = track_next();
  const int slot = map().add_frame(num_images_, T_cam_world);
  map().retire_gross_outliers(slot);
  const std::size_t num_active = map().tracks.active().size();
  int wrong = -1;
  for (const int index : map().tracks.active()) {
    if (map().tracks[index].host != slot) wrong = index;
  }
  ASSERT_GE(wrong, 0);
  Track& track = map().tracks[wrong];
  track.observe(slot, track.xy + Eigen::Vector2d(10.0 / 360.0, 0.0));
  map().retire_gross_outliers(slot);
  EXPECT_EQ(map().tracks.active().size(), num_active - 1);
  EXPECT_EQ(map().tracks.passive().back(), wrong);
  EXPECT_FALSE(track.seen_in(slot));
}

TEST_F(LocalMapTest, OutliersAreFreed) {
  const Se3 T_cam_world = track_next();
  const int slot = map().add_frame(num_images_, T_cam_world);
  map().free_outliers();
  const std::size_t num_active = map().tracks.active().size();
  const int wrong = map().tracks.active()[0];
  Track& track = map().tracks[wrong];
  track.observe(slot, track.xy + Eigen::Vector2d(5.0 / 360.0, 0.0));
  map().free_outliers();
  EXPECT_EQ(map().tracks.active().size(), num_active - 1);
  for (const int index : map().tracks.active()) EXPECT_NE(index, wrong);
  EXPECT_EQ(map().tracks.add(), wrong) << "its place is free";
}

}  // namespace
}  // namespace plumb::vo
