/// Reads what describes a camera beside its recording.
#pragma once

#include <filesystem>

#include "modules/camera/camera_config.hpp"

namespace plumb {

/// Reads a TOML file with [camera], as plumb-camera takes it, or a KITTI calib.txt, of which P0,
/// residual_k1, residual_k2, camera_height_m and readout_s count. Throws InputError or ConfigError.
[[nodiscard]] CameraConfig read_camera_file(const std::filesystem::path& path);

/// camera.toml or calib.txt in the folder of a recording, or in the one above; empty for none.
[[nodiscard]] std::filesystem::path find_camera_file(const std::filesystem::path& recording);

}  // namespace plumb
