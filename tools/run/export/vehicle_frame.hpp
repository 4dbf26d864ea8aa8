/// Poses of the vehicle from those of its camera.
///
/// Frames:
///   world:    cam of the first image (x right, y down, z forward), as in ego_motion_t.
///   vehicle:  x forward in the direction of travel, y left, z up (ISO 8855), on the road under the
///             camera. The camera's orientation in it is the mean over the drive.
///   odom:     vehicle at the first image.
#pragma once

#include "core/numbers.hpp"
#include "core/se3.hpp"
#include "tools/run/export/drive_results.hpp"

namespace plumb {

/// T_vehicle_cam: pitch, roll and height are the means of all measured planes of the drive; yaw is
/// the one found by the mount check, and 0 while that has found none. Without a measured plane the
/// camera is level at its calibrated height.
[[nodiscard]] Se3 vehicle_from_camera(const DriveResults& drive);

/// T_odom_vehicle of a frame with a pose.
[[nodiscard]] Se3 vehicle_pose(const Se3& T_vehicle_cam, const Se3& T_world_cam);

/// Covariance of T_odom_vehicle: [m^2, m rad, rad^2] of the position and of a rotation about the
/// fixed axes of odom, as ROS states it.
/// @param cov_world_cam  of the position (world) and of a right perturbation of the rotation
[[nodiscard]] Matrix6d vehicle_pose_covariance(const Se3& T_vehicle_cam, const Se3& T_world_cam,
                                               const Matrix6d& cov_world_cam);

/// Velocity of the vehicle's origin [m/s] and angular rates [rad/s] in the vehicle's axes, with
/// their covariance.
struct VehicleTwist {
  Vector6d mean = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Identity();
};

/// Empty while the motion or its duration is not known.
[[nodiscard]] std::optional<VehicleTwist> vehicle_twist(const Se3& T_vehicle_cam,
                                                        const FrameResult& frame);

/// T_world_cam of a frame. @pre has_pose(frame)
[[nodiscard]] Se3 camera_pose(const FrameResult& frame);

/// T_cam_road: road has the axes of `ground` in the messages. @pre has_plane(frame)
[[nodiscard]] Se3 camera_from_road(const ground_plane_t& plane);

}  // namespace plumb
