/// Poses of raw drives from their GPS/IMU unit.
///
/// As KITTI's raw development kit: a Mercator projection whose scale is that of the first latitude,
/// and R = Rz(yaw) Ry(pitch) Rx(roll).
/// Frames   imu: x forward, y left, z up.  cam: the left rectified camera.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/se3.hpp"
#include "modules/datasets/kitti/image_list.hpp"

namespace plumb {

/// The calibration files of a raw drive: beside the drive's folders or one folder up.
struct RawCalibration {
  std::filesystem::path cam_to_cam;  ///< empty when not there, like the others
  std::filesystem::path velo_to_cam;
  std::filesystem::path imu_to_velo;
};
[[nodiscard]] RawCalibration find_raw_calibration(const std::filesystem::path& drive);

/// T_cam_imu out of the three files. Throws InputError.
[[nodiscard]] Se3 read_T_cam_imu(const RawCalibration& files);

/// World of the result: the first image's left camera. An image without its oxts file has no pose.
/// Throws InputError for files that are not oxts.
[[nodiscard]] std::vector<std::optional<Se3>> read_oxts_poses(
    const std::filesystem::path& data_folder, const std::vector<NumberedImage>& images,
    const Se3& T_cam_imu);

}  // namespace plumb
