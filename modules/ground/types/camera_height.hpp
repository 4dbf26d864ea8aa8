/// The camera's height over the road: the one length that turns VO's unit into metres.
///
/// Units:
///   Metres.
#pragma once

#include "core/camera_model.hpp"
#include "modules/ground/types/ground_config.hpp"

namespace plumb {

struct CameraHeight {
  double height_m = 0.0;  ///< optical centre above the road under the car; > 0
  double std_m = 0.0;     ///< 1-sigma

  [[nodiscard]] double var_ratio() const {
    const double ratio = std_m / height_m;
    return ratio * ratio;
  }
};

/// The calibration's height where it states one, else the configured one.
[[nodiscard]] inline CameraHeight camera_height_of(const GroundConfig& config,
                                                   const CameraModel& camera) {
  const bool stated = camera.camera_height_m > 0.0;
  return {stated ? camera.camera_height_m : config.camera_height_m, config.camera_height_std_m};
}

}  // namespace plumb
