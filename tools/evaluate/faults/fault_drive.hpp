/// A recorded drive, taken apart so that faults can be put into it.
///
/// Units:
///   microseconds, m/s. Pictures are 8-bit grey, rows packed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/camera_model.hpp"

namespace plumb {

using Pixels = std::shared_ptr<const std::vector<std::uint8_t>>;

/// One image of the drive, as it was recorded.
struct RecordedImage {
  std::int64_t capture_us = 0;
  std::int64_t seq = 0;
  Pixels pixels;
  double speed_m_s = 0.0;   ///< true mean speed since the image before
  double position_m = 0.0;  ///< true distance travelled since the first image, smoothed
};

struct FaultDrive {
  std::string name;
  CameraModel camera;
  std::vector<RecordedImage> images;
};

/// Reads CAMERA, CAMERA_CALIBRATION and GROUND_TRUTH of a log.
/// Throws LogError when it cannot be read, InputError when it lacks one of the three.
[[nodiscard]] FaultDrive read_fault_drive(const std::string& log);

}  // namespace plumb
