#include "modules/vo/orientation_check.hpp"

#include <gtest/gtest.h>

#include <random>

namespace plumb::vo {
namespace {

constexpr double kCameraHeight = 1.5;

class OrientationCheckTest : public ::testing::Test {
 protected:
  /// Shows `num` points of the road, at `up` -1 to a camera that is upside down.
  void show_road(int num, double up = 1.0) {
    for (int i = 0; i < num; ++i)
      show(kCameraHeight * std::uniform_real_distribution(0.95, 1.05)(random_), up);
  }
  /// Shows points of walls between the road and `height` over it.
  void show_walls(int num, double height, double up = 1.0) {
    for (int i = 0; i < num; ++i) {
      show(kCameraHeight - std::uniform_real_distribution(0.0, height)(random_), up);
    }
  }
  void show_street(double up = 1.0) {
    check_.begin({0.0, 0.01, 1.0});
    show_road(80, up);
    show_walls(120, 9.0, up);
    check_.end();
  }
  void show_streets(int num, double up = 1.0) {
    for (int i = 0; i < num; ++i) show_street(up);
  }

  std::mt19937 random_{5};
  OrientationCheck check_{500};

 private:
  /// Shows one point, `down` below the line of travel.
  void show(double down, double up) {
    const double z = std::uniform_real_distribution(6.0, 40.0)(random_);
    check_.add({0.2, 0.01 + up * down / z}, 1.0 / z, 0.1 / z);
  }
};

TEST_F(OrientationCheckTest, AStreetProvesAnUprightCameraInTwoImages) {
  EXPECT_EQ(check_.verdict(), Orientation::kUnseen);
  show_street();
  EXPECT_EQ(check_.verdict(), Orientation::kUnproven);
  show_street();
  EXPECT_EQ(check_.verdict(), Orientation::kUpright);
}

TEST_F(OrientationCheckTest, AStreetAboveProvesThatItIsUpsideDown) {
  for (int i = 0; i < 50; ++i) {
    show_street(-1.0);
    EXPECT_NE(check_.verdict(), Orientation::kUpright) << i;
  }
  EXPECT_EQ(check_.verdict(), Orientation::kUpsideDown);
}

TEST_F(OrientationCheckTest, TheSameReachOnBothSidesProvesNothing) {
  for (int i = 0; i < 50; ++i) {
    check_.begin({0.0, 0.01, 1.0});
    show_walls(200, 2.0 * kCameraHeight);
    check_.end();
  }
  EXPECT_EQ(check_.verdict(), Orientation::kUnproven);
}

TEST_F(OrientationCheckTest, ARoadUnderAnEmptySkyIsBelow) {
  for (const double up : {1.0, -1.0}) {
    OrientationCheck fresh(500);
    check_ = fresh;
    for (int i = 0; i < (up > 0.0 ? 2 : 8); ++i) {
      check_.begin({0.0, 0.01, 1.0});
      show_road(60, up);
      check_.end();
    }
    EXPECT_EQ(check_.verdict(), up > 0.0 ? Orientation::kUpright : Orientation::kUpsideDown);
  }
}

TEST_F(OrientationCheckTest, LampsOverADarkRoadProveNothing) {
  for (int i = 0; i < 50; ++i) {
    check_.begin({0.0, 0.01, 1.0});
    for (int k = 0; k < 60; ++k) {
      const double z = 10.0 + k;
      check_.add({0.1, 0.01 - (0.5 + 0.1 * k) / z}, 1.0 / z, 0.05 / z);
    }
    check_.end();
  }
  EXPECT_EQ(check_.verdict(), Orientation::kUnproven);
}

TEST_F(OrientationCheckTest, WhatMovesAlongBelowTheHorizonProvesNothing) {
  for (int i = 0; i < 50; ++i) {
    check_.begin({0.0, 0.01, 1.0});
    show_walls(120, 3.0);
    for (int k = 0; k < 80; ++k) check_.add({0.1, 0.1 + 0.002 * k}, 0.005, 0.001);
    check_.end();
  }
  EXPECT_EQ(check_.verdict(), Orientation::kUnproven) << "a bare motorway, seen by compression";
}

TEST_F(OrientationCheckTest, WallsAreNoRoadAbove) {
  for (int i = 0; i < 50; ++i) {
    check_.begin({0.0, 0.01, 1.0});
    show_walls(120, 9.0);
    for (int k = 0; k < 80; ++k) check_.add({0.1, 0.1}, 0.005, 0.001);
    check_.end();
  }
  EXPECT_EQ(check_.verdict(), Orientation::kUnproven);
}

TEST_F(OrientationCheckTest, AFewImagesDisproveNothing) {
  show_streets(100);
  show_streets(20, -1.0);
  EXPECT_EQ(check_.verdict(), Orientation::kUpright);
  show_streets(40, -1.0);
  EXPECT_EQ(check_.verdict(), Orientation::kUpsideDown);
}

TEST_F(OrientationCheckTest, ATurnedCameraIsBelievedAgain) {
  show_streets(100, -1.0);
  ASSERT_EQ(check_.verdict(), Orientation::kUpsideDown);
  int num = 0;
  for (; check_.verdict() != Orientation::kUpright && num < 100; ++num) show_street();
  EXPECT_LE(num, 11);
}

TEST_F(OrientationCheckTest, AfterALossItIsDisprovedSoon) {
  show_streets(100);
  check_.loosen();
  EXPECT_EQ(check_.verdict(), Orientation::kUpright);
  show_streets(3, -1.0);
  EXPECT_EQ(check_.verdict(), Orientation::kUnproven);
  show_streets(5, -1.0);
  EXPECT_EQ(check_.verdict(), Orientation::kUpsideDown);
}

TEST_F(OrientationCheckTest, ADiscontinuityForgets) {
  show_streets(100);
  check_.reset();
  EXPECT_EQ(check_.verdict(), Orientation::kUnproven);
  show_streets(6, -1.0);
  EXPECT_EQ(check_.verdict(), Orientation::kUpsideDown);
}

TEST_F(OrientationCheckTest, TracksWithoutDepthAndSidewaysTravelTellNothing) {
  for (int i = 0; i < 5; ++i) {
    check_.begin({0.0, 0.0, 1.0});
    for (int k = 0; k < 100; ++k) check_.add({0.0, k % 2 == 0 ? 0.2 : -0.5}, 0.1, 0.06);
    check_.end();
    check_.begin({1.0, 0.0, 0.1});
    show_road(100);
    check_.end();
  }
  EXPECT_EQ(check_.verdict(), Orientation::kUnproven);
}

}  // namespace
}  // namespace plumb::vo
