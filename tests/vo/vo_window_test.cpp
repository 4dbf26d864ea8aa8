#include "modules/vo/window.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "modules/vo/track.hpp"

namespace plumb::vo {
namespace {

const std::vector<std::uint8_t> kBlank(64 * 64, 7);
const ImageView kImage{kBlank.data(), 64, 64, 64};

Se3 at(double z) { return {exp_so3({0.0, 0.01 * z, 0.0}), {0.0, 0.0, -z}}; }

TEST(Window, KeepsKeyframesAndTheLastThreeFrames) {
  Window window(64, 64);
  for (int i = 0; i < 6; ++i) {
    const int slot = window.add(i, at(i));
    if (i == 1) window.make_keyframe(slot, kImage);
  }
  ASSERT_GE(window.stale_frame(), 0);
  EXPECT_EQ(window[window.stale_frame()].seq, 0);
  window.remove(window.stale_frame());
  EXPECT_EQ(window[window.stale_frame()].seq, 2);  // 1 is a keyframe
  window.remove(window.stale_frame());
  EXPECT_EQ(window.stale_frame(), -1);
  EXPECT_EQ(window.order().size(), 4U);
  EXPECT_EQ(window[window.newest()].seq, 5);
  EXPECT_EQ(window[window.newest_keyframe()].seq, 1);
}

TEST(Window, StoresACopyOfAKeyframesImage) {
  Window window(64, 64);
  std::vector<std::uint8_t> pixels(64 * 64, 9);
  const int slot = window.add(0, Se3{});
  window.make_keyframe(slot, {pixels.data(), 64, 64, 64});
  pixels.assign(pixels.size(), 0);
  EXPECT_EQ(window.image(slot).at(63, 63), 9);
}

TEST(Window, PastPosesFollowTheFrameTheyAreRelativeTo) {
  Window window(64, 64);
  window.make_keyframe(window.add(0, at(0.0)), kImage);
  const int middle = window.add(1, at(1.0));
  const int last = window.add(2, at(2.0));
  window.remove(middle);
  EXPECT_LT((window.past_pose(window.history()[1]).t - at(1.0).t).norm(), 1e-12);
  const Se3 correction{exp_so3({0.0, 0.1, 0.0}), {0.5, 0.0, 0.0}};
  window[last].T_cam_world = window[last].T_cam_world * correction;  // the newest frame is refined
  EXPECT_LT((window.past_pose(window.history()[1]).t - (at(1.0) * correction).t).norm(), 1e-12);
}

TEST(Window, TheHistoryHasTheLastTwelveFramesNewestFirst) {
  Window window(64, 64);
  window.make_keyframe(window.add(0, at(0.0)), kImage);
  for (int i = 1; i < 30; ++i) window.remember(i, at(0.1 * i), i % 2 == 0);
  EXPECT_EQ(window.num_history(), kHistory);
  for (int i = 0; i < kHistory; ++i) {
    const PastFrame& past = window.history()[static_cast<std::size_t>(i)];
    EXPECT_EQ(past.seq, 29 - i);
    EXPECT_EQ(past.measured, past.seq % 2 == 0);
    EXPECT_LT((window.past_pose(past).t - at(0.1 * static_cast<double>(past.seq)).t).norm(), 1e-12);
  }
}

TEST(TrackTable, FreedTracksAreUsedAgainAndRefusedWhenFull) {
  TrackTable tracks(4);
  for (int i = 0; i < 4; ++i) EXPECT_GE(tracks.add(), 0);
  EXPECT_EQ(tracks.add(), -1);
  const int freed = tracks.active()[1];
  tracks.sift_active([&](int index) {
    return index == freed ? TrackTable::Fate::kFree : TrackTable::Fate::kRetire;
  });
  EXPECT_TRUE(tracks.active().empty());
  EXPECT_EQ(tracks.passive().size(), 3U);
  EXPECT_EQ(tracks.add(), freed);
  tracks.sift_passive([](int) { return false; });
  for (int i = 0; i < 3; ++i) EXPECT_GE(tracks.add(), 0);
  EXPECT_EQ(tracks.add(), -1);
}

TEST(Track, HasTheSlotsInWhichItWasSeen) {
  Track track;
  track.observe(3, {0.1, 0.2});
  track.observe(11, {0.3, 0.4}, {0.0, -0.25});
  EXPECT_TRUE(track.shown_xy_in(11).isApprox(Eigen::Vector2d(0.3, 0.15)));
  EXPECT_EQ(track.shown_xy_in(3), track.xy_in(3));
  EXPECT_TRUE(track.seen_in(3));
  EXPECT_FALSE(track.seen_in(4));
  track.remove_observation(3);
  EXPECT_FALSE(track.seen_in(3));
  EXPECT_EQ(track.xy_in(11), Eigen::Vector2d(0.3, 0.4));
}

}  // namespace
}  // namespace plumb::vo
