#include "modules/vo/road_points.hpp"

#include <gtest/gtest.h>

#include "tests/vo/synthetic_window.hpp"

namespace plumb::vo {
namespace {

using test::SyntheticWindow;

class RoadPointsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const int index : window_.tracks.active()) {
      Track& track = window_.tracks[index];
      track.num_images = 3;
      track.px = {static_cast<double>(index), 1.0};
    }
  }
  /// Collects the points as the last frame sees them.
  void collect() { collect_road_points(window_.tracks, window_.window, T_last(), &points_); }
  [[nodiscard]] Se3 T_last() const { return window_.T_cam_world.back(); }
  /// Position in the last frame, by the truth.
  [[nodiscard]] Eigen::Vector3d truth_cam(int index) const {
    const Track& track = window_.tracks[index];
    const Se3 T_world_host = window_.T_cam_world[static_cast<std::size_t>(track.host)].inverse();
    const double rho = window_.rho[static_cast<std::size_t>(index)];
    return T_last() * (T_world_host * (track.host_xy.homogeneous() / rho));
  }

  SyntheticWindow window_{6, 200, 0.0};
  FixedVector<RoadPoint, kMaxRoadPoints> points_;
};

TEST_F(RoadPointsTest, AreTheTracksBelowTheHorizonWhereTheyAre) {
  collect();
  ASSERT_GT(points_.size(), 50U);
  std::size_t num_below = 0;
  for (const int index : window_.tracks.active()) {
    if (truth_cam(index).y() > 0.0) ++num_below;
  }
  EXPECT_EQ(points_.size(), num_below);
  for (const RoadPoint& point : points_) {
    const Eigen::Vector3d truth = truth_cam(static_cast<int>(point.px.x()));
    EXPECT_LT((point.p_cam.cast<double>() - truth).norm(), 1e-4 * truth.norm());
    EXPECT_GT(point.p_cam.y(), 0.0F);
    EXPECT_EQ(point.num_obs, 3);
  }
}

TEST_F(RoadPointsTest, LeaveOutTracksWithUncertainDepth) {
  collect();
  const auto uncertain = static_cast<int>(points_[0].px.x());
  const std::size_t num = points_.size();
  Track& track = window_.tracks[uncertain];
  track.rho_std = 0.6 * track.rho;
  collect();
  EXPECT_EQ(points_.size(), num - 1);
  track.rho_std = 0.3 * track.rho;
  collect();
  ASSERT_EQ(points_.size(), num);
  EXPECT_GT(points_[0].rel_std, 0.2F);
}

TEST_F(RoadPointsTest, LeaveOutTracksThatFewImagesSaw) {
  collect();
  const auto young = static_cast<int>(points_[0].px.x());
  const std::size_t num = points_.size();
  window_.tracks[young].num_images = 2;
  collect();
  EXPECT_EQ(points_.size(), num - 1);
}

}  // namespace
}  // namespace plumb::vo
