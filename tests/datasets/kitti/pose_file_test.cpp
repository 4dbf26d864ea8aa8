#include "modules/datasets/kitti/pose_file.hpp"

#include <gtest/gtest.h>

#include "core/se3.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/kitti_data.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

TEST(PoseFile, ReadsBackWhatItWrote) {
  PoseMatrix T_world_cam = PoseMatrix::Identity();
  T_world_cam.topLeftCorner<3, 3>() = exp_so3({0.1, -0.7, 0.02});
  T_world_cam.topRightCorner<3, 1>() = Eigen::Vector3d(1234.567, -2.5, 8e-5);
  const test::TempFolder folder;
  const auto poses = read_poses(folder.write("p.txt", pose_row(T_world_cam) + "\n"));
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_LT((poses[0] - T_world_cam).cwiseAbs().maxCoeff(), 1e-6);
  const Eigen::Matrix3d off = (poses[0] - T_world_cam).topLeftCorner<3, 3>();
  EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PoseFile, RefusesWhatIsNoPose) {
  const test::TempFolder folder;
  const auto error = [&](const std::string& row) {
    return input_error_of([&] { (void)read_poses(folder.write("p.txt", row + "\n")); });
  };
  expect_contains(error("1 0 0 0 0 1 0 0 0 0 1"), "p.txt:1: 11 numbers, expected 12");
  expect_contains(error("2 0 0 0 0 1 0 0 0 0 1 0"), "p.txt:1: columns 1-3, 5-7 and 9-11");
  expect_contains(error("-1 0 0 0 0 1 0 0 0 0 1 0"), "not a rotation");
}

TEST(PoseFile, ReadsRealKittiPoses) {
  const auto folder = test::kitti_sequence("odometry/sequences/05_100-159");
  if (folder.empty()) GTEST_SKIP() << test::kNoKitti;
  const auto poses = read_poses(folder / "poses.txt");
  ASSERT_EQ(poses.size(), 60U);
  const Eigen::Vector3d start_m = poses.front().topRightCorner<3, 1>();
  EXPECT_GT(start_m.norm(), 90.0) << "the first row is not the identity";
}

}  // namespace
}  // namespace plumb
