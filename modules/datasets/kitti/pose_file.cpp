#include "modules/datasets/kitti/pose_file.hpp"

#include <Eigen/LU>

#include <cstdio>
#include <string>

#include "core/input_error.hpp"
#include "modules/datasets/number_file.hpp"

namespace plumb {

std::vector<PoseMatrix> read_poses(const std::filesystem::path& path) {
  std::vector<PoseMatrix> poses;
  for (const NumberRow& row : read_number_rows(path, 12, 12)) {
    PoseMatrix T_world_cam = PoseMatrix::Identity();
    for (int i = 0; i < 12; ++i) {
      T_world_cam(i / 4, i % 4) = row.values[static_cast<std::size_t>(i)];
    }
    const Eigen::Matrix3d R = T_world_cam.topLeftCorner<3, 3>();
    const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    if (off > 0.01 || R.determinant() < 0.0) {
      throw InputError(path.string() + ":" + std::to_string(row.line) +
                       ": columns 1-3, 5-7 and 9-11 are not a rotation");
    }
    poses.push_back(T_world_cam);
  }
  return poses;
}

std::string pose_row(const PoseMatrix& T_world_cam) {
  std::string row;
  for (int i = 0; i < 12; ++i) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%.9e", i == 0 ? "" : " ", T_world_cam(i / 4, i % 4));
    row += number;
  }
  return row;
}

}  // namespace plumb
