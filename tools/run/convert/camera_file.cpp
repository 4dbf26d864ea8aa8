#include "tools/run/convert/camera_file.hpp"

#include <utility>

#include "core/input_error.hpp"
#include "modules/chain/plumb_config.hpp"
#include "modules/datasets/kitti/calibration.hpp"
#include "platform/config.hpp"

namespace plumb {
namespace {

CameraConfig read_calib_txt(const std::filesystem::path& path) {
  const CalibrationFile file(path);
  const CameraModel camera = read_projection(file, "P0").model;
  CameraConfig config;
  config.fx_px = camera.fx_px;
  config.fy_px = camera.fy_px;
  config.cx_px = camera.cx_px;
  config.cy_px = camera.cy_px;
  config.residual_k1 = file.optional_number("residual_k1").value_or(0.0);
  config.residual_k2 = file.optional_number("residual_k2").value_or(0.0);
  config.camera_height_m = file.optional_number("camera_height_m").value_or(0.0);
  config.readout_s = file.optional_number("readout_s").value_or(0.0);
  return config;
}

}  // namespace

CameraConfig read_camera_file(const std::filesystem::path& path) {
  if (path.extension() == ".txt") return read_calib_txt(path);
  PlumbConfig config;
  load_config(path.string(), &config);
  const CameraConfig& camera = config.camera;
  const std::pair<const char*, double> needed[] = {{"camera.fx_px", camera.fx_px},
                                                   {"camera.fy_px", camera.fy_px},
                                                   {"camera.cx_px", camera.cx_px},
                                                   {"camera.cy_px", camera.cy_px}};
  for (const auto& [key, value] : needed) {
    if (value == 0.0) throw InputError(path.string() + " does not state " + key);
  }
  return camera;
}

}  // namespace plumb
