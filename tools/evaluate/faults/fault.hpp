/// Faults of camera, clock and source, as sequences of images made of a sound drive.
///
/// Units:
///   microseconds, m/s.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

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

/// A row of the fault matrix.
struct Fault {
  std::string name;
  char kind = 'A';       ///< letter of the kind, see docs/faults.md
  std::string injected;  ///< what is done to the drive, in words
  std::function<FaultRun(const FaultDrive&)> make;
};

/// The drive as it was recorded.
[[nodiscard]] FaultRun sound_run(const FaultDrive& drive);

/// A copy of a picture that `edit` has changed.
[[nodiscard]] Pixels edited_picture(const Pixels& from,
                                    const std::function<void(std::vector<std::uint8_t>*)>& edit);

/// Every fault that can be put into a recorded drive. The first row is the sound drive.
[[nodiscard]] const std::vector<Fault>& all_faults();

}  // namespace plumb
