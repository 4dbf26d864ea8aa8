#include "modules/datasets/kitti/plane_file.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

TEST(PlaneFile, ReadsTheLidarFormatAndPassesOverFurtherColumns) {
  const test::TempFolder folder;
  const auto planes = read_planes(
      folder.write("p.txt", "# frame nx ny nz h ...\n7 0.0 0.9998 0.02 1.66 5576 5576 0.0122\n"));
  ASSERT_EQ(planes.count(7), 1U);
  EXPECT_DOUBLE_EQ(planes.at(7).height_m, 1.66);
  EXPECT_NEAR(planes.at(7).normal_cam.norm(), 1.0, 1e-15);
}

TEST(PlaneFile, CallsNoseDownPositivePitch) {
  // WHEN the optical axis points 2 degrees below the horizon,
  // the road's downward normal leans forward.
  const double angle_rad = 0.0349;
  const TruePlane plane{{0.0, std::cos(angle_rad), std::sin(angle_rad)}, 1.65};
  EXPECT_NEAR(plane.pitch_rad(), angle_rad, 1e-12);
  EXPECT_NEAR(plane.roll_rad(), 0.0, 1e-12);
}

TEST(PlaneFile, CallsRightSideDownPositiveRoll) {
  // WHEN the camera's right side is low, "down" has a component to the camera's right.
  const double angle_rad = 0.01;
  const TruePlane plane{{std::sin(angle_rad), std::cos(angle_rad), 0.0}, 1.65};
  EXPECT_NEAR(plane.roll_rad(), angle_rad, 1e-12);
  EXPECT_NEAR(plane.pitch_rad(), 0.0, 1e-12);
}

TEST(PlaneFile, RefusesWhatIsNoPlane) {
  const test::TempFolder folder;
  const auto error = [&](const std::string& row) {
    return input_error_of([&] { (void)read_planes(folder.write("p.txt", row + "\n")); });
  };
  expect_contains(error("0 0 0.5 0 1.65"), "p.txt:1: columns 2-4 are not a unit normal");
  expect_contains(error("0 0 -1 0 1.65"), "points down");
  expect_contains(error("0 0 1 0 -1.65"), "height");
  expect_contains(error("0 0 1 0"), "4 numbers");
  expect_contains(error("3 0 1 0 1.6\n3 0 1 0 1.6"), "p.txt:2: frame 3 is given twice");
}

}  // namespace
}  // namespace plumb
