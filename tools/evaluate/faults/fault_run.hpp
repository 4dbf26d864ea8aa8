/// A drive as the chain gets it, image by image, and the ways to make one from a recorded drive.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/camera_model.hpp"
#include "tools/evaluate/faults/fault_drive.hpp"

namespace plumb {

/// One image as the chain gets it, with what is really so.
struct Shot {
  std::int64_t stamp_us = 0;  ///< as the image states it
  std::int64_t seq = 0;
  Pixels pixels;
  std::int64_t true_us = 0;      ///< when the chain gets it, on a clock that never lies
  double true_speed_m_s = 0.0;   ///< of the car at that time
  bool faulty = false;           ///< this image, its stamp or its number is wrong
  double true_position_m = 0.0;  ///< distance travelled since the drive's first image
};

struct FaultRun {
  CameraModel camera;  ///< as CAMERA_CALIBRATION states it
  std::vector<Shot> shots;
};

/// The drive as it was recorded.
[[nodiscard]] FaultRun sound_run(const FaultDrive& drive);

/// At most `count` images from `first` on, every n-th, in an n-th of the time: a car that drives n
/// times as fast. The true positions belong to the recorded stamps, jitter included.
[[nodiscard]] FaultRun faster_run(const FaultDrive& drive, std::size_t first, std::size_t n,
                                  std::size_t count);

/// A copy of a picture that `edit` has changed.
[[nodiscard]] Pixels edited_picture(const Pixels& from,
                                    const std::function<void(std::vector<std::uint8_t>*)>& edit);

}  // namespace plumb
