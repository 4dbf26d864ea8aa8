/// Reads the poses of raw drives, which their GPS/IMU unit measured.
///
/// Model:
///   As in KITTI's raw development kit: a Mercator projection with the scale of the first latitude,
///   and R = Rz(yaw) Ry(pitch) Rx(roll).
/// Frames:
///   imu: x forward, y left, z up. cam: the left rectified camera.
/// Errors:
///   Functions throw InputError.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/se3.hpp"
#include "modules/datasets/kitti/image_list.hpp"

namespace plumb {

/// The calibration files of a raw drive. A path is empty when its file does not exist.
struct RawCalibration {
  std::filesystem::path cam_to_cam;
  std::filesystem::path velo_to_cam;
  std::filesystem::path imu_to_velo;
};
/// Looks for the calibration files in the drive's folder and in the folder above it.
[[nodiscard]] RawCalibration find_raw_calibration(const std::filesystem::path& drive);

/// Computes T_cam_imu from the three files.
[[nodiscard]] Se3 read_T_cam_imu(const RawCalibration& files);

/// Reads T_world_cam of every image; the world is the left camera of the first image. An image
/// without an oxts file has no pose. Throws for a file that is not an oxts file.
[[nodiscard]] std::vector<std::optional<Se3>> read_oxts_poses(
    const std::filesystem::path& data_folder, const std::vector<NumberedImage>& images,
    const Se3& T_cam_imu);

}  // namespace plumb
