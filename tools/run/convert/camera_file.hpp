/// Reads the file that describes the camera of a recording.
#pragma once

#include <filesystem>

#include "modules/camera/camera_config.hpp"

namespace plumb {

/// Reads the settings `camera.*` of a TOML file, or a KITTI calib.txt (a name that ends in .txt),
/// of which P0, residual_k1, residual_k2, camera_height_m and readout_s count. Throws ConfigError,
/// or InputError also when focal length or principal point are not stated.
[[nodiscard]] CameraConfig read_camera_file(const std::filesystem::path& path);

}  // namespace plumb
