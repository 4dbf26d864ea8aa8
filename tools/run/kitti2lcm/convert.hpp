/// Converts a KITTI sequence to an LCM log.
///
/// The log has CAMERA_CALIBRATION at the beginning and once a second, and per frame GROUND_TRUTH
/// where there is truth, CAMERA, and DETECTIONS where there are boxes. Events carry the true
/// capture times. VEHICLE_SPEED, when it is wanted, is the mean true speed between two images, at
/// the time between them.
#pragma once

#include <cstdint>
#include <filesystem>

#include "modules/datasets/kitti/sequence.hpp"

namespace plumb {

struct ConvertOptions {
  std::filesystem::path out;
  bool jpeg = false;                      ///< true: JPEG of quality 95; false: plain pixels
  std::filesystem::path detections = {};  ///< KITTI tracking file; empty: none
  std::filesystem::path candidates = {};  ///< boxes before suppression for them; empty: none
  bool vehicle_speed = false;             ///< true: VEHICLE_SPEED from the true poses
};

struct ConvertResult {
  std::int64_t num_frames = 0;
  std::int64_t num_poses = 0;
  std::int64_t num_planes = 0;
  std::int64_t num_detections = 0;
  std::int64_t log_bytes = 0;
  double duration_s = 0.0;
  const char* concern = nullptr;  ///< what is doubtful about the calibration, in plain words
  bool stopped = false;           ///< by a signal; the log has the frames up to then
};

/// Shows its progress on stderr. Throws InputError for a bad image and LogError for a log that
/// cannot be written; what was written before is a sound log either way.
ConvertResult convert(const Sequence& sequence, const ConvertOptions& options);

}  // namespace plumb
