/// KITTI pose files: one row per frame, the first three rows of T_world_cam, 12 numbers row by row.
///
/// Frames   cam: x right, y down, z forward.  world: whatever the file's author chose.
/// Units    metres.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

namespace plumb {

/// T_world_cam as a 4x4 matrix. Kept as written: rows of six decimals are not exact rotations, and
/// the devkit does not make them so.
using PoseMatrix = Eigen::Matrix4d;

/// Throws InputError for anything but rows of 12 finite numbers whose 3x3 part is a rotation to 1
/// %.
[[nodiscard]] std::vector<PoseMatrix> read_poses(const std::filesystem::path& path);

/// One row of a pose file, without the line end: nine decimals in exponent form, enough that
/// rounding is below the truth's own.
[[nodiscard]] std::string pose_row(const PoseMatrix& T_world_cam);

}  // namespace plumb
