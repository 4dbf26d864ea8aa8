/// How the camera sits on its vehicle, out of the whole chain run over drives.
///
/// Angles  of the camera against the direction of travel on straight stretches (yaw: camera looks left of it positive)
///         and against the road (pitch: nose down positive; roll: right side down positive), medians over frames.
/// Height  only against a metric reference, the true poses of a log: the height at which the chain's way gets the true
///         length.
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
