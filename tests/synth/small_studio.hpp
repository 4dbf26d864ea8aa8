/// Configures small drives that render in a moment.
#pragma once

#include "tools/synth/studio.hpp"

namespace plumb::synth::test {

/// A drive of `frames` frames at a quarter of KITTI's resolution, without mount angles, noise, blur
/// or traffic.
inline SynthConfig small_config(const char* route, int frames) {
  SynthConfig config;
  config.route = route;
  config.frames = frames;
  config.seed = 7;
  config.drive.seed = 7;
  config.scene.seed = 7;
  config.scene.traffic = 0;
  CameraModel& camera = config.render.camera;
  camera.width_px = 621;
  camera.height_px = 188;
  camera.fx_px = 360.0;
  camera.fy_px = 360.0;
  camera.cx_px = 304.7;
  camera.cy_px = 86.4;
  camera.camera_height_m = 1.65;
  return config;
}

}  // namespace plumb::synth::test
