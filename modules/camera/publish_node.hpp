/// Publishes grey frames as CAMERA and CAMERA_CALIBRATION, and reports image faults in the health
/// of the process.
#pragma once

#include <cstdint>
#include <filesystem>

#include "modules/camera/camera_node.hpp"
#include "modules/camera/recorded_source.hpp"
#include "platform/process.hpp"

namespace plumb {

class PublishNode {
 public:
  /// The arguments are those of CameraNode. Throws UsageError.
  PublishNode(Process& process, const CameraConfig& config, const std::filesystem::path& folder);

  /// Publishes the frame. The calibration is published before the first frame and then once per
  /// second of the camera's time. The last stage that this marks is "publish".
  void publish(const GreyFrame& frame);

  /// Reports the fault of the newest images in the health of the process.
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
