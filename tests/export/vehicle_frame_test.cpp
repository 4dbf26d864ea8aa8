/// Tests the vehicle's poses and their covariance against definitions and numeric derivatives.
#include "tools/run/export/vehicle_frame.hpp"

#include <gtest/gtest.h>

#include "core/numbers.hpp"
#include "core/pose_wire.hpp"
#include "tests/support/central_difference.hpp"

namespace plumb {
namespace {

FrameResult with_plane(double pitch_rad, double height_m) {
  FrameResult frame;
  frame.plane.emplace();
  frame.plane->status = ground_plane_t::STATUS_OK;
  to_wire<3>(Eigen::Vector3d(0.0, std::cos(pitch_rad), std::sin(pitch_rad)),
             frame.plane->normal_cam);
  frame.plane->height_m = height_m;
  return frame;
}

Se3 tilted_mount() {
  return {exp_so3({0.02, -0.03, 0.01}) * Eigen::Matrix3d{{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}},
          {0.0, 0.0, 1.6}};
}

TEST(VehicleFrame, LevelsTheMeanCameraAndStandsOnTheRoad) {
  DriveResults drive;
  drive.frames = {with_plane(0.03, 1.5), with_plane(0.05, 1.7)};
  FrameResult held = with_plane(0.5, 9.0);
  held.plane->status = ground_plane_t::STATUS_HELD;
  drive.frames.push_back(held);
  drive.mount_yaw_rad = 0.1;
  const Se3 T_vehicle_cam = vehicle_from_camera(drive);
  EXPECT_NEAR(T_vehicle_cam.t.z(), 1.6, 1e-12);
  // The camera looks 0.04 rad down and 0.1 rad to the left.
  const Eigen::Vector3d axis = T_vehicle_cam.R * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(std::asin(-axis.z()), 0.04, 1e-9);
  EXPECT_NEAR(std::atan2(axis.y(), axis.x()), 0.1, 1e-9);
}

TEST(VehicleFrame, WithoutAPlaneTheCameraIsLevelAtItsCalibratedHeight) {
  DriveResults drive;
  drive.camera.emplace();
  drive.camera->camera_height_m = 1.2;
  const Se3 T_vehicle_cam = vehicle_from_camera(drive);
  EXPECT_TRUE((T_vehicle_cam * Eigen::Vector3d(0.0, 1.2, 5.0))
                  .isApprox(Eigen::Vector3d(5.0, 0.0, 0.0), 1e-12));
}

TEST(VehicleFrame, CovarianceFollowsTheDerivativesOfThePose) {
  const Se3 mount = tilted_mount();
  const Se3 T_world_cam{exp_so3({0.1, 0.4, -0.2}), {3.0, -0.5, 20.0}};
  const Se3 nominal = vehicle_pose(mount, T_world_cam);
  const auto moved = [&](const Vector6d& x) {
    Se3 T = T_world_cam;
    T.R *= exp_so3(x.tail<3>());
    for (int i = 0; i < 3; ++i) T.t[i] += x[i];
    const Se3 pose = vehicle_pose(mount, T);
    const Eigen::Vector3d turn = log_so3(pose.R * nominal.R.transpose());
    Vector6d out;
    for (int i = 0; i < 3; ++i) out[i] = pose.t[i], out[i + 3] = turn[i];
    return out;
  };
  const Matrix6d J = test::central_difference<6, 6>(moved, Vector6d(Vector6d::Zero()), 1e-6);
  Matrix6d root;
  for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = 0.01 * ((7 * i + 3) % 11 - 5);
  const Matrix6d cov = root * root.transpose();
  const Matrix6d expected = J * cov * J.transpose();
  EXPECT_LT((vehicle_pose_covariance(mount, T_world_cam, cov) - expected).norm(),
            1e-7 * expected.norm());
}

TEST(VehicleFrame, TwistIsTheMotionOverItsInterval) {
  FrameResult frame;
  frame.interval_s = 0.1;
  EXPECT_FALSE(vehicle_twist(tilted_mount(), frame)) << "no motion";
  ego_motion_t& ego = frame.ego.emplace();
  ego.status = ego_motion_t::STATUS_OK;
  ego.speed_std_m_s = 0.5;
  ego.yaw_rate_std_rad_s = 0.02;
  // The vehicle drives 1 m ahead and turns 0.05 rad to the left.
  const Se3 T_prev_now{exp_so3({0.0, 0.0, 0.05}), {1.0, 0.025, 0.0}};
  to_wire(tilted_mount().inverse() * T_prev_now * tilted_mount(), ego.q_prev_cam, ego.t_prev_cam_m);
  const auto twist = vehicle_twist(tilted_mount(), frame);
  ASSERT_TRUE(twist);
  EXPECT_NEAR(twist->mean[0], 10.0, 0.01);
  EXPECT_NEAR(twist->mean[5], 0.5, 1e-9);
  EXPECT_DOUBLE_EQ(twist->covariance(0, 0), 0.25);
  EXPECT_DOUBLE_EQ(twist->covariance(5, 5), 0.02 * 0.02);
  frame.interval_s = kNan;
  EXPECT_FALSE(vehicle_twist(tilted_mount(), frame)) << "no duration";
}

}  // namespace
}  // namespace plumb
