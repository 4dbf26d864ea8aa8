/// Finds how the camera sits on its vehicle by running the whole chain over drives.
///
/// Angles:
///   Medians over frames. Yaw is measured against the direction of travel on straight
///   stretches and is positive when the camera looks to the left of it. Pitch (positive nose
///   down) and roll (positive right side down) are measured against the road.
/// Height:
///   The height at which the chain's path gets the true length. It needs a metric reference:
///   true poses in the log.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/chain/plumb_config.hpp"
#include "tools/learn/calibrate/recorded_drive.hpp"

namespace plumb {

struct MountValue {
  double value = 0.0;
  double std = 0.0;
  int num_frames = 0;
  std::string missing;  ///< why it could not be observed; empty when it was
  [[nodiscard]] bool observed() const { return missing.empty(); }
};

struct Mount {
  MountValue pitch_rad;
  MountValue roll_rad;
  MountValue yaw_rad;
  MountValue height_m;
};

/// `camera` replaces the drives' stated one. Throws Stopped.
[[nodiscard]] Mount find_mount(const std::vector<RecordedDrive>& drives, const CameraModel& camera,
                               const PlumbConfig& config, std::uint64_t seed);

}  // namespace plumb
