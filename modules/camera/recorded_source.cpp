#include "modules/camera/recorded_source.hpp"

#include "platform/process.hpp"

namespace plumb {

void complete_size(const std::string& file, int width_px, int height_px, CameraConfig* config) {
  const bool same_width = config->width_px == 0 || config->width_px == width_px;
  const bool same_height = config->height_px == 0 || config->height_px == height_px;
  if (!same_width || !same_height) {
    throw UsageError(file + " is " + std::to_string(width_px) + "x" + std::to_string(height_px) +
                     ", camera.width_px and camera.height_px say " +
                     std::to_string(config->width_px) + "x" + std::to_string(config->height_px));
  }
  config->width_px = width_px;
  config->height_px = height_px;
}

}  // namespace plumb
