#include "modules/vo/attached_regions.hpp"

#include <gtest/gtest.h>

namespace plumb::vo {
namespace {

const Eigen::Vector2d kPlace(200.0, 180.0);

class AttachedRegionsTest : public ::testing::Test {
 protected:
  /// Shows a track at `px` in `num` images.
  void show(int num, const Eigen::Vector2d& px, double moved_px, double off_px,
            bool must_move = false) {
    for (int i = 0; i < num; ++i) {
      regions_.add({px, moved_px, off_px, must_move});
      regions_.end_image(0.05);
    }
  }

  AttachedRegions regions_{640, 200};
};

TEST_F(AttachedRegionsTest, WhatStaysWhileTheCameraTurnsIsAttached) {
  show(20, kPlace, 0.2, 3.0);
  EXPECT_FALSE(regions_.covers(kPlace)) << "one second is too little";
  show(20, kPlace, 0.2, 3.0);
  EXPECT_TRUE(regions_.covers(kPlace));
  EXPECT_FALSE(regions_.covers(kPlace + Eigen::Vector2d(3.0 * AttachedRegions::kCellPx, 0.0)));
  EXPECT_DOUBLE_EQ(regions_.share(), 1.0 / (40.0 * 13.0));
}

TEST_F(AttachedRegionsTest, AFarPointIsNotAttached) {
  show(200, kPlace, 3.0, 0.2);  // the camera turns
  show(200, kPlace, 0.1, 0.1);  // and does not
  EXPECT_FALSE(regions_.covers(kPlace));
}

TEST_F(AttachedRegionsTest, AVehicleThatMovesIsNotAttached) {
  show(200, kPlace, 30.0, 20.0);
  EXPECT_FALSE(regions_.covers(kPlace));
}

TEST_F(AttachedRegionsTest, WhatStaysWhereTheRoadPassesIsAttached) {
  show(40, kPlace, 0.3, 0.3, true);
  EXPECT_TRUE(regions_.covers(kPlace)) << "although the camera does not turn";
}

TEST_F(AttachedRegionsTest, ALeaderFollowsTheRotation) {
  show(200, kPlace, 2.0, 0.2, true);
  EXPECT_FALSE(regions_.covers(kPlace));
}

TEST_F(AttachedRegionsTest, APlaceThatShowsTheWorldIsBelievedForLonger) {
  show(200, kPlace, 10.0, 0.2);
  show(30, kPlace, 0.2, 3.0);
  EXPECT_FALSE(regions_.covers(kPlace));
}

TEST_F(AttachedRegionsTest, WhatIsAttachedIsTriedAgainAfterAMinute) {
  show(100, kPlace, 0.2, 3.0);
  ASSERT_TRUE(regions_.covers(kPlace));
  double passed_s = 0.0;
  for (; regions_.covers(kPlace) && passed_s < 100.0; passed_s += 0.05) regions_.end_image(0.05);
  EXPECT_GT(passed_s, 20.0);
  EXPECT_LT(passed_s, 65.0);
}

TEST_F(AttachedRegionsTest, ListsItsCellsAndTakesTheEdgeOfTheImage) {
  const Eigen::Vector2d edge(639.0, 199.0);
  show(60, edge, 0.2, 3.0);
  EXPECT_TRUE(regions_.covers(edge));
  int num = 0;
  regions_.for_each([&](const Eigen::Vector2i& first_px) {
    ++num;
    EXPECT_EQ(first_px, Eigen::Vector2i(624, 192));
  });
  EXPECT_EQ(num, 1);
}

}  // namespace
}  // namespace plumb::vo
