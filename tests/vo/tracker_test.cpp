#include "modules/vo/tracker.hpp"

#include <gtest/gtest.h>

#include "core/percentile.hpp"
#include "tests/vo/map_fixture.hpp"

namespace plumb::vo {
namespace {

using test::MapFixture;
using test::scene_camera;

/// A camera that turns on the spot: the true positions do not depend on depths.
class TrackerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    fixture_.initialize(Se3{});
    fixture_.show({R_world_cam_, Eigen::Vector3d::Zero()});
    fixture_.map.tracker.begin(tracks(), 0.1);
    num_started_ = tracks().active().size();
    ASSERT_GT(num_started_, 100U);
  }

  [[nodiscard]] TrackTable& tracks() { return fixture_.map.tracks; }
  [[nodiscard]] Se3 T_cam_world() const {
    return {R_world_cam_.transpose(), Eigen::Vector3d::Zero()};
  }

  /// True position in the newest image.
  [[nodiscard]] Eigen::Vector2d truth_px(const Track& track) const {
    return scene_camera().project(R_world_cam_.transpose() * track.host_xy.homogeneous());
  }
  [[nodiscard]] double median_error_px() {
    std::vector<double> errors;
    for (const int index : tracks().active()) {
      errors.push_back((tracks()[index].px - truth_px(tracks()[index])).norm());
    }
    return upper_median(errors);
  }
  /// A predicted pose that is turned by `yaw_rad` from the true one.
  [[nodiscard]] Se3 turned(double yaw_rad) const {
    return {exp_so3({0.0, yaw_rad, 0.0}) * T_cam_world().R, Eigen::Vector3d::Zero()};
  }
  int search(const Se3& T_predicted, bool wide) {
    LocalMap& map = fixture_.map;
    map.tracker.predict_by_pose(map.tracks, map.window, Se3{}, T_predicted);
    return map.tracker.search(map.last_image(), map.newest_image(), map.tracks, wide);
  }

  const Eigen::Matrix3d R_world_cam_ = exp_so3({0.004, 0.06, 0.01});  // about 22 px
  MapFixture fixture_;
  std::size_t num_started_ = 0;
};

TEST_F(TrackerTest, FindsTheTracksWhereTheyArePredicted) {
  EXPECT_GT(search(T_cam_world(), false),
            static_cast<int>(0.8 * static_cast<double>(num_started_)));
  fixture_.map.tracker.drop_missing(tracks());
  EXPECT_LT(median_error_px(), 0.15);
}

TEST_F(TrackerTest, FindsTracksAFewPixelsFromThePrediction) {
  EXPECT_GT(search(turned(0.01), false), static_cast<int>(0.7 * static_cast<double>(num_started_)));
  fixture_.map.tracker.drop_missing(tracks());
  EXPECT_LT(median_error_px(), 0.15);
}

TEST_F(TrackerTest, AWideSearchReachesFarther) {
  const int num_narrow = search(Se3{}, false);  // about 22 px off
  const int num_wide = search(Se3{}, true);
  EXPECT_GT(num_wide, num_narrow + 5);
}

TEST_F(TrackerTest, ASecondSearchAddsToTheFirst) {
  const int num_first = search(turned(0.04), false);
  EXPECT_LT(num_first, static_cast<int>(0.5 * static_cast<double>(num_started_)));
  const int num_both = search(T_cam_world(), false);
  EXPECT_GT(num_both, static_cast<int>(0.8 * static_cast<double>(num_started_)));
  fixture_.map.tracker.drop_missing(tracks());
  EXPECT_LT(median_error_px(), 0.15);
}

TEST_F(TrackerTest, TracksThatLeaveTheImageAreRetired) {
  static_cast<void>(search(T_cam_world(), true));
  fixture_.map.tracker.drop_missing(tracks());
  EXPECT_EQ(tracks().active().size() + tracks().passive().size(), num_started_);
  int num_outside = 0;
  for (const int index : tracks().passive()) {
    if (truth_px(tracks()[index]).x() < 0.0) ++num_outside;
  }
  EXPECT_GT(num_outside, 2);
  for (const int index : tracks().active()) EXPECT_GT(tracks()[index].px.x(), 0.0);
}

TEST_F(TrackerTest, FlowIsRepeated) {
  static_cast<void>(search(T_cam_world(), true));
  fixture_.map.tracker.drop_missing(tracks());
  LocalMap& map = fixture_.map;
  map.keep_image(T_cam_world());
  // The same rotation again: every track moves by about as much as before.
  const Eigen::Matrix3d R_world_next = R_world_cam_ * R_world_cam_;
  fixture_.show({R_world_next, Eigen::Vector3d::Zero()});
  const auto num_before = static_cast<double>(tracks().active().size());
  map.tracker.begin(tracks(), 0.1);
  map.tracker.predict_by_flow(tracks());
  const int num_found = map.tracker.search(map.last_image(), map.newest_image(), tracks(), false);
  EXPECT_GT(num_found, static_cast<int>(0.8 * num_before));
}

TEST_F(TrackerTest, AligningWithTheHostRemovesDrift) {
  static_cast<void>(search(T_cam_world(), false));
  fixture_.map.tracker.drop_missing(tracks());
  for (const int index : tracks().active()) tracks()[index].px += Eigen::Vector2d(0.5, -0.4);
  ASSERT_GT(median_error_px(), 0.5);
  const auto num_before = static_cast<double>(tracks().active().size());
  fixture_.map.tracker.align_to_hosts(fixture_.map.newest_image().level(0), tracks(),
                                      fixture_.map.window, T_cam_world());
  EXPECT_GT(static_cast<double>(tracks().active().size()), 0.9 * num_before);
  EXPECT_LT(median_error_px(), 0.15);
}

TEST_F(TrackerTest, TracksWhosePatchIsGoneAreRetired) {
  static_cast<void>(search(T_cam_world(), false));
  fixture_.map.tracker.drop_missing(tracks());
  const auto num_before = static_cast<double>(tracks().active().size());
  // The image is of another place, the positions are of the old one.
  fixture_.show({R_world_cam_, {0.0, 0.0, 37.0}});
  fixture_.map.tracker.align_to_hosts(fixture_.map.newest_image().level(0), tracks(),
                                      fixture_.map.window, T_cam_world());
  EXPECT_LT(static_cast<double>(tracks().active().size()), 0.3 * num_before);
}

}  // namespace
}  // namespace plumb::vo
