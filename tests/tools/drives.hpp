/// Makes trajectories with known errors.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/se3.hpp"
#include "modules/datasets/kitti/pose_file.hpp"

namespace plumb::test {

inline PoseMatrix to_matrix(const Se3& T) {
  PoseMatrix matrix = PoseMatrix::Identity();
  matrix.topLeftCorner<3, 3>() = T.R;
  matrix.topRightCorner<3, 1>() = T.t;
  return matrix;
}

/// Makes `num_frames` poses that repeat one motion from frame to frame, from the identity on.
inline std::vector<PoseMatrix> repeat(const Se3& T_prev_cam, int num_frames) {
  std::vector<PoseMatrix> poses;
  Se3 T_world_cam;
  for (int i = 0; i < num_frames; ++i) {
    poses.push_back(to_matrix(T_world_cam));
    T_world_cam = T_world_cam * T_prev_cam;
  }
  return poses;
}

/// The motion ahead by `step_m` with a turn to the right by `yaw_rad`.
inline Se3 drive_step(double step_m, double yaw_rad = 0.0) {
  return {exp_so3({0.0, yaw_rad, 0.0}), {0.0, 0.0, step_m}};
}

inline std::string to_file(const std::vector<PoseMatrix>& poses) {
  std::string text;
  for (const PoseMatrix& pose : poses) text += pose_row(pose) + "\n";
  return text;
}

}  // namespace plumb::test
