/// Reads and writes KITTI pose files. Each row has the first three rows of one frame's T_world_cam:
/// 12 numbers in row-major order.
///
/// Frames:
///   cam: x right, y down, z forward. The world is the choice of the file's author.
/// Units:
///   Translations are in metres.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

namespace plumb {

/// T_world_cam as a 4x4 matrix, with the numbers of the file. Numbers of six decimals do not form
/// an exact rotation, and KITTI's development kit does not correct that either.
using PoseMatrix = Eigen::Matrix4d;

/// Reads the poses. Throws InputError for a row that is not 12 finite numbers or whose 3x3 part is
/// not a rotation to within 1 %.
[[nodiscard]] std::vector<PoseMatrix> read_poses(const std::filesystem::path& path);

/// Formats one row of a pose file without its line end. Nine decimals in exponent form keep the
/// rounding below that of the truth.
[[nodiscard]] std::string pose_row(const PoseMatrix& T_world_cam);

}  // namespace plumb
