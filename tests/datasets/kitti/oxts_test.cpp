#include "modules/datasets/kitti/oxts.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "modules/datasets/text.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

constexpr double kMetresPerDegree = 6378137.0 * std::numbers::pi / 180.0;

std::string oxts_row(double lat_deg, double lon_deg, double alt_m, double roll, double pitch,
                     double yaw) {
  std::string row =
      format("%.12f %.12f %.6f %.9f %.9f %.9f", lat_deg, lon_deg, alt_m, roll, pitch, yaw);
  for (int i = 6; i < 30; ++i) row += " 0";
  return row + "\n";
}

std::vector<NumberedImage> images(int count) {
  std::vector<NumberedImage> list;
  for (int i = 0; i < count; ++i) list.push_back({i, {}});
  return list;
}

/// A camera at the position of the IMU, with z along the IMU's x and x along the IMU's -y.
Se3 T_cam_imu() {
  Se3 T;
  T.R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return T;
}

TEST(Oxts, DrivingEastIsDrivingAhead) {
  const test::TempFolder folder;
  // At the equator a degree of longitude is as long as one of latitude,
  // and the Mercator scale is 1.
  folder.write("data/0000000000.txt", oxts_row(0.0, 8.0, 100.0, 0, 0, 0));
  folder.write("data/0000000001.txt", oxts_row(0.0, 8.0 + 10.0 / kMetresPerDegree, 101.0, 0, 0, 0));
  const auto poses = read_oxts_poses(folder / "data", images(2), T_cam_imu());
  ASSERT_TRUE(poses[0] && poses[1]);
  EXPECT_LT(poses[0]->t.norm(), 1e-6);
  // The second pose is 10 m ahead (z) and 1 m up (-y).
  EXPECT_LT((poses[1]->t - Eigen::Vector3d(0, -1, 10)).norm(), 1e-5);
}

TEST(Oxts, ALeftTurnIsAboutTheCamerasUpAxis) {
  const test::TempFolder folder;
  const double yaw = 0.1;  // positive to the left, from east
  folder.write("data/0000000000.txt", oxts_row(49.0, 8.0, 100.0, 0, 0, 0));
  folder.write("data/0000000001.txt", oxts_row(49.0, 8.0, 100.0, 0, 0, yaw));
  const auto poses = read_oxts_poses(folder / "data", images(2), T_cam_imu());
  EXPECT_TRUE(poses[1]->R.isApprox(exp_so3({0.0, -yaw, 0.0}), 1e-9));
}

TEST(Oxts, TheLeverBetweenImuAndCameraSwingsInATurn) {
  const test::TempFolder folder;
  folder.write("data/0000000000.txt", oxts_row(49.0, 8.0, 100.0, 0, 0, 0));
  folder.write("data/0000000001.txt", oxts_row(49.0, 8.0, 100.0, 0, 0, std::numbers::pi / 2));
  // WHEN the camera is 1 m ahead of the IMU and the car turns left on the spot,
  Se3 T = T_cam_imu();
  T.t = {0.0, 0.0, -1.0};
  const auto poses = read_oxts_poses(folder / "data", images(2), T);
  // THEN the camera has moved 1 m back and 1 m to the left.
  EXPECT_LT((poses[1]->t - Eigen::Vector3d(-1, 0, -1)).norm(), 1e-9);
}

TEST(Oxts, AFrameWithoutItsFileHasNoPose) {
  const test::TempFolder folder;
  folder.write("data/0000000000.txt", oxts_row(49, 8, 0, 0, 0, 0));
  folder.write("data/0000000002.txt", oxts_row(49, 8, 0, 0, 0, 0));
  const auto poses = read_oxts_poses(folder / "data", images(3), T_cam_imu());
  EXPECT_TRUE(poses[0]);
  EXPECT_FALSE(poses[1]);
  EXPECT_TRUE(poses[2]);
}

TEST(Oxts, RefusesFilesThatAreNotOxts) {
  const test::TempFolder folder;
  folder.write("data/0000000000.txt", "49 8 0\n");
  expect_contains(
      input_error_of([&] { (void)read_oxts_poses(folder / "data", images(1), T_cam_imu()); }),
      "3 numbers, expected 30");
  folder.write("data/0000000000.txt", oxts_row(89.9, 8, 0, 0, 0, 0));
  expect_contains(
      input_error_of([&] { (void)read_oxts_poses(folder / "data", images(1), T_cam_imu()); }),
      "latitude");
}

}  // namespace
}  // namespace plumb
