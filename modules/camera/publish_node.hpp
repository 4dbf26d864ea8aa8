/// Grey frames in, CAMERA and CAMERA_CALIBRATION out, image faults into health.
#pragma once

#include <cstdint>
#include <filesystem>

#include "modules/camera/camera_node.hpp"
#include "modules/camera/recorded_source.hpp"
#include "platform/process.hpp"

namespace plumb {

class PublishNode {
 public:
  /// As CameraNode. Throws UsageError.
  PublishNode(Process& process, const CameraConfig& config, const std::filesystem::path& folder);

  /// Publishes the frame; the calibration goes before the first one and then once a second of the
  /// camera's time. Marks stages, up to "publish".
  void publish(const GreyFrame& frame);

  /// What is wrong with the newest images becomes the health of the process.
  void show_fault();

 private:
  Process& process_;
  CameraNode node_;
  Publisher<image_t> image_;
  Publisher<camera_calibration_t> calibration_;
  bool calibrated_ = false;
  std::int64_t calibrated_us_ = 0;
};

}  // namespace plumb
