/// The options of plumb-camera, which two programs share.
#pragma once

#include <string>

#include "platform/command_line.hpp"

namespace plumb {

struct CameraOptions {
  std::string device;
  std::string kitti;
  int kitti_camera = 0;
  std::string video;
  std::string images;
  double rate_hz = 0.0;
  double speed = 1.0;
};

inline void declare_camera_options(CommandLine& app, CameraOptions* options) {
  Option device = app.add_option("--device", options->device, "V4L2 device; default camera.device");
  Option kitti =
      app.add_option("--kitti", options->kitti, "KITTI folder: image_<n>, times.txt, calib.txt");
  Option video = app.add_option("--video", options->video, "video file");
  Option images =
      app.add_option("--images", options->images, "folder of images, in the order of their names");
  app.add_option("--rate", options->rate_hz,
                 "images/s of --images; default: times.txt, or times in the names")
      .check(within(0.1, 1000.0))
      .needs(images);
  app.add_option("--kitti-camera", options->kitti_camera, "which image_<n>; default 0")
      .check(within(0, 3))
      .needs(kitti);
  app.add_option("--speed", options->speed,
                 "pace of a recording; default 1, 0 is as fast as it goes")
      .check(within(0.0, 1000.0))
      .excludes(device);
  device.excludes(kitti).excludes(video).excludes(images);
  kitti.excludes(video).excludes(images);
  video.excludes(images);
}

inline constexpr const char* kCameraSummary =
    "Camera, video, folder of images or KITTI folder -> CAMERA";

}  // namespace plumb
