#include "modules/vo/features.hpp"

#include <gtest/gtest.h>

#include "tests/vo/synthetic_window.hpp"

namespace plumb::vo {
namespace {

using test::SyntheticWindow;

/// A window of 200 static features of known depth. The camera turns by 0.01 rad between keyframes,
/// which moves the farthest point by more than 7 px.
class FeaturesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const int index : window_.tracks.active()) place(index, window_.tracks[index].xy);
  }
  void place(int index, const Eigen::Vector2d& xy) {
    Track& track = window_.tracks[index];
    track.xy = xy;
    track.px = camera_.from_normalized(xy);
    track.host_px = camera_.from_normalized(track.host_xy);
  }
  /// The kind of a feature as the last frame sees it.
  [[nodiscard]] FeatureKind kind_of(int index) {
    collect_features(window_.tracks, window_.window, window_.T_cam_world.back(), camera_,
                     &features_);
    return features_[static_cast<std::size_t>(index)].kind;
  }

  CameraModel camera_{1242, 375, 720.0, 720.0, 620.5, 187.0, 0.0, 0.0, 1.65};
  SyntheticWindow window_{6, 200, 0.0};
  FixedVector<Feature, kMaxFeatures> features_;
};

TEST_F(FeaturesTest, WhatThePoseExplainsIsStatic) {
  (void)kind_of(0);
  ASSERT_EQ(features_.size(), 200U);
  for (std::size_t i = 0; i < features_.size(); ++i) {
    EXPECT_EQ(features_[i].kind, FeatureKind::kStatic) << i;
    EXPECT_EQ(features_[i].px, window_.tracks[static_cast<int>(i)].px.cast<float>());
  }
}

TEST_F(FeaturesTest, WhatThePoseDoesNotExplainMoves) {
  const Eigen::Vector2d xy = window_.tracks[7].xy;
  place(7, xy + Eigen::Vector2d(0.0, 1.0 / 720.0));
  EXPECT_EQ(kind_of(7), FeatureKind::kStatic) << "two deviations";
  place(7, xy + Eigen::Vector2d(0.0, 1.75 / 720.0));
  EXPECT_EQ(kind_of(7), FeatureKind::kUndecided) << "3.5 deviations";
  place(7, xy + Eigen::Vector2d(0.0, 4.0 / 720.0));
  EXPECT_EQ(kind_of(7), FeatureKind::kMoving) << "eight deviations";
  EXPECT_EQ(kind_of(8), FeatureKind::kStatic);
}

TEST_F(FeaturesTest, WhatDoesNotMoveWhileTheCameraTurnsIsAttached) {
  const Eigen::Vector2d host_xy = window_.tracks[7].host_xy;
  place(7, host_xy + Eigen::Vector2d(0.5 / 720.0, 0.0));
  EXPECT_EQ(kind_of(7), FeatureKind::kAttached);
  place(7, host_xy + Eigen::Vector2d(1.0 / 720.0, 0.0));
  EXPECT_EQ(kind_of(7), FeatureKind::kMoving) << "it has moved";
}

TEST_F(FeaturesTest, ALeadVehicleOnAStraightRoadIsNotTakenForAttached) {
  // Without rotation, a vehicle ahead that is as fast as the camera does not move in the image,
  // either. Its depth seems to be infinite, and nothing tells it from the horizon.
  Window window(64, 64);
  const std::vector<std::uint8_t> blank(64 * 64, 0);
  for (int i = 0; i < 2; ++i) {
    const int slot = window.add(i, {Eigen::Matrix3d::Identity(), {0.0, 0.0, -double(i)}});
    window.make_keyframe(slot, {blank.data(), 64, 64, 64});
  }
  TrackTable tracks(4);
  Track& track = tracks[tracks.add()];
  track.host = 0;
  track.host_xy = track.xy = {0.1, 0.05};
  track.px = track.host_px = camera_.from_normalized(track.xy);
  track.rho = 0.1;
  track.rho_std = 0.001;
  collect_features(tracks, window, window[1].T_cam_world, camera_, &features_);
  EXPECT_EQ(features_[0].kind, FeatureKind::kMoving);
  track.rho = kMinRho;
  collect_features(tracks, window, window[1].T_cam_world, camera_, &features_);
  EXPECT_EQ(features_[0].kind, FeatureKind::kStatic);
}

TEST_F(FeaturesTest, AnUncertainDepthLeavesTheKindOpen) {
  window_.tracks[7].rho_std = kUnknownRhoStd;
  EXPECT_EQ(kind_of(7), FeatureKind::kUndecided);
  // Away from the epipolar line, no depth explains it.
  place(7, window_.tracks[7].xy + Eigen::Vector2d(0.02, 0.05));
  EXPECT_EQ(kind_of(7), FeatureKind::kMoving);
}

TEST_F(FeaturesTest, NewOnesFollowUndecided) {
  (void)kind_of(0);
  add_undecided_features(window_.tracks, 3, &features_);
  ASSERT_EQ(features_.size(), 203U);
  EXPECT_EQ(features_[202].px, window_.tracks[199].px.cast<float>());
  EXPECT_EQ(features_[202].kind, FeatureKind::kUndecided);
}

}  // namespace
}  // namespace plumb::vo
