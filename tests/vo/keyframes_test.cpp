#include "modules/vo/keyframes.hpp"

#include <gtest/gtest.h>

#include "tests/vo/map_fixture.hpp"

namespace plumb::vo {
namespace {

using test::MapFixture;
using test::scene_camera;

class KeyframesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    fixture_.initialize(Se3{});
    num_ = map().keyframes.num_at_keyframe();
    ASSERT_GT(num_, 100);
  }
  [[nodiscard]] LocalMap& map() { return fixture_.map; }

  /// Adds a frame at the given pose that sees every active track where it is, and a keyframe of it.
  int add_keyframe(std::int64_t seq, const Se3& T_cam_world) {
    const int slot = map().add_frame(seq, T_cam_world);
    map().keyframes.promote(slot, map().newest_image().level(0), map().tracks, map().window);
    return slot;
  }

  MapFixture fixture_;
  int num_ = 0;
};

TEST_F(KeyframesTest, ParallaxMakesAKeyframe) {
  const double limit_px = MapFixture::config().keyframe_parallax_px;
  EXPECT_TRUE(map().keyframes.is_needed({limit_px + 0.1, num_, num_}));
  EXPECT_FALSE(map().keyframes.is_needed({limit_px - 0.1, num_, num_}));
}

TEST_F(KeyframesTest, ASmallOverlapMakesAKeyframeUnlessThereIsNoParallax) {
  const double limit = MapFixture::config().keyframe_overlap_ratio * num_;
  const int few = static_cast<int>(limit) - 1;
  EXPECT_TRUE(map().keyframes.is_needed({2.5, few, num_}));
  EXPECT_FALSE(map().keyframes.is_needed({2.5, few + 2, num_}));
  EXPECT_FALSE(map().keyframes.is_needed({1.5, few, num_}));
}

TEST_F(KeyframesTest, FewTracksMakeAKeyframeAtALowerParallax) {
  const int few = num_ / 2 - 1;
  EXPECT_TRUE(map().keyframes.is_needed({1.5, few, few}));
  EXPECT_FALSE(map().keyframes.is_needed({1.5, few + 2, few + 2}));
  EXPECT_FALSE(map().keyframes.is_needed({0.5, few, few}));
}

TEST_F(KeyframesTest, ARotationHasNoParallax) {
  const Eigen::Matrix3d R = exp_so3({0.0, -0.03, 0.0});
  for (const int index : map().tracks.active()) {
    Track& track = map().tracks[index];
    track.px = scene_camera().project(R * track.host_xy.homogeneous());
  }
  const Keyframes::Overlap turned =
      map().keyframes.compare(map().tracks, map().window, {R, Eigen::Vector3d::Zero()});
  EXPECT_LT(turned.median_parallax_px, 1e-6);
  EXPECT_EQ(turned.num_shared, num_);
  EXPECT_EQ(turned.num_tracks, num_);
  const Keyframes::Overlap moved = map().keyframes.compare(map().tracks, map().window, Se3{});
  EXPECT_GT(moved.median_parallax_px, 5.0);
}

TEST_F(KeyframesTest, TracksStartOnlyWhereThereAreNone) {
  const int slot = map().window.newest();
  const int num_more = map().keyframes.start_tracks(slot, map().last_image(), map().attached,
                                                    map().tracks, map().window);
  EXPECT_LT(num_more, num_ / 10);
  std::vector<Eigen::Vector2d> px;
  for (const int index : map().tracks.active()) px.push_back(map().tracks[index].px);
  for (std::size_t i = 0; i < px.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((px[i] - px[j]).norm(), 4.0);
  }
}

TEST_F(KeyframesTest, ANewTrackGetsTheDepthOfItsNeighbours) {
  for (const int index : map().tracks.active()) {
    Track& track = map().tracks[index];
    EXPECT_EQ(track.rho, kTypicalRho) << "there were no neighbours";
    EXPECT_EQ(track.rho_std, kUnknownRhoStd);
    track.rho = 0.2;
    track.rho_std = 0.001;
  }
  // Half of the tracks go, so that new ones start in their cells.
  map().tracks.sift_active(
      [](int index) { return index % 2 == 0 ? TrackTable::Fate::kStay : TrackTable::Fate::kFree; });
  const int slot = add_keyframe(1, Se3{});
  const int num_new = map().keyframes.start_tracks(slot, map().last_image(), map().attached,
                                                   map().tracks, map().window);
  ASSERT_GT(num_new, num_ / 4);
  for (const int index : map().tracks.active()) {
    const Track& track = map().tracks[index];
    if (track.host != slot) continue;
    EXPECT_NEAR(track.rho, 0.2, 1e-12);
    EXPECT_GT(track.rho_std, 0.1) << "it is only a prediction";
  }
}

TEST_F(KeyframesTest, TheOldestKeyframeLeavesAndItsTracksChangeHost) {
  for (int i = 1; i < kMaxKeyframes; ++i) {
    add_keyframe(i, {Eigen::Matrix3d::Identity(), {0.0, 0.0, -0.1 * i}});
  }
  const int oldest = map().window.oldest_keyframe();
  const int second = map().window.order()[1];
  ASSERT_EQ(map().window[oldest].seq, 0);
  ASSERT_EQ(map().window.num_keyframes(), kMaxKeyframes);
  for (const int index : map().tracks.active()) ASSERT_EQ(map().tracks[index].host, oldest);
  // The tracks of the second half were not seen since: nobody can host them.
  const int first_lost = num_ / 2;
  for (const int index : map().tracks.active()) {
    if (index >= first_lost) map().tracks[index].seen = 1U << oldest;
  }
  map().window.make_keyframe(map().window.add(kMaxKeyframes, Se3{}), map().newest_image().level(0));
  map().keyframes.remove_frame(oldest, map().tracks, map().window);
  EXPECT_EQ(map().window.num_keyframes(), kMaxKeyframes);
  EXPECT_EQ(map().tracks.active().size(), static_cast<std::size_t>(first_lost));
  for (const int index : map().tracks.active()) EXPECT_EQ(map().tracks[index].host, second);
}

TEST_F(KeyframesTest, OtherFramesLeaveWhenTheyAreNoLongerRecent) {
  for (int i = 1; i <= kNumRecent + 2; ++i) {
    map().add_frame(i, Se3{});
    map().keyframes.trim_recent(map().tracks, map().window);
  }
  ASSERT_EQ(map().window.order().size(), static_cast<std::size_t>(kNumRecent + 1));
  EXPECT_EQ(map().window[map().window.order()[0]].seq, 0);
  EXPECT_EQ(map().window[map().window.order()[1]].seq, 3);
}

}  // namespace
}  // namespace plumb::vo
