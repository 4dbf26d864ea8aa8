#include "tools/run/export/vehicle_frame.hpp"

#include <algorithm>
#include <cmath>

#include "core/input_error.hpp"
#include "core/pose_wire.hpp"
#include "modules/datasets/text.hpp"
#include "modules/ground/filter/plane_angles.hpp"

namespace plumb {

Se3 vehicle_from_camera(const DriveResults& drive) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double height_m = 0.0;
  int num_planes = 0;
  for (const FrameResult& frame : drive.frames) {
    if (!frame.plane || frame.plane->status != ground_plane_t::STATUS_OK) continue;
    normal += Eigen::Vector3d(frame.plane->normal_cam);
    height_m += frame.plane->height_m;
    ++num_planes;
  }
  if (num_planes > 0 && normal.norm() > 0.0) {
    normal.normalize();
    height_m /= num_planes;
  } else {
    normal = Eigen::Vector3d::UnitY();
    height_m = drive.camera ? drive.camera->camera_height_m : 0.0;
  }
  const Eigen::AngleAxisd yaw(drive.mount_yaw_rad.value_or(0.0), Eigen::Vector3d::UnitZ());
  return {yaw.toRotationMatrix() * rotation_ground_cam(normal), {0.0, 0.0, height_m}};
}

Se3 vehicle_pose(const Se3& T_vehicle_cam, const Se3& T_world_cam) {
  return T_vehicle_cam * T_world_cam * T_vehicle_cam.inverse();
}

Matrix6d vehicle_pose_covariance(const Se3& T_vehicle_cam, const Se3& T_world_cam,
                                 const Matrix6d& cov_world_cam) {
  // With A = T_vehicle_cam and b = t of its inverse: t_odom_vehicle = R_A (R b + t) + t_A, and R
  // exp(w^) moves it by -R_A R b^ w and turns the vehicle by R_A R w about the axes of odom.
  const Eigen::Matrix3d R_odom_cam = T_vehicle_cam.R * T_world_cam.R;
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = T_vehicle_cam.R;
  J.topRightCorner<3, 3>() = -R_odom_cam * hat(T_vehicle_cam.inverse().t);
  J.bottomRightCorner<3, 3>() = R_odom_cam;
  return J * cov_world_cam * J.transpose();
}

std::optional<VehicleTwist> vehicle_twist(const Se3& T_vehicle_cam, const FrameResult& frame) {
  Se3 T_prev_cam;
  Matrix6d cov_prev_cam;
  const double dt_s = frame.interval_s;
  if (!(dt_s > 0.0) || !has_pose(frame) || std::isnan(frame.ego->speed_std_m_s) ||
      from_wire(frame.ego->q_prev_cam, frame.ego->t_prev_cam_m, &T_prev_cam) != nullptr ||
      from_wire(frame.ego->cov_prev_cam, &cov_prev_cam) != nullptr) {
    return {};
  }
  const Se3 T_prev_now = vehicle_pose(T_vehicle_cam, T_prev_cam);
  VehicleTwist twist;
  twist.mean << T_prev_now.R.transpose() * T_prev_now.t / dt_s, log_so3(T_prev_now.R) / dt_s;
  twist.covariance =
      vehicle_pose_covariance(T_vehicle_cam, T_prev_cam, cov_prev_cam) / (dt_s * dt_s);
  // The stated deviations know the error of the interval, too. Larger variances keep the matrix
  // positive.
  double& forward_var = twist.covariance(0, 0);
  double& yaw_rate_var = twist.covariance(5, 5);
  forward_var = std::max(forward_var, square(frame.ego->speed_std_m_s));
  yaw_rate_var = std::max(yaw_rate_var, square(frame.ego->yaw_rate_std_rad_s));
  return twist;
}

Se3 camera_pose(const FrameResult& frame) {
  Se3 T_world_cam;
  if (const char* why = from_wire(frame.ego->q_world_cam, frame.ego->t_world_cam_m, &T_world_cam)) {
    throw InputError(
        format("EGO_MOTION of image %lld: %s", static_cast<long long>(frame.seq), why));
  }
  return T_world_cam;
}

Se3 camera_from_road(const ground_plane_t& plane) {
  const Eigen::Vector3d normal_cam(plane.normal_cam);
  return {rotation_ground_cam(normal_cam).transpose(), plane.height_m * normal_cam};
}

}  // namespace plumb
