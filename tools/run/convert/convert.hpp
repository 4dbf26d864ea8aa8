/// Writes a recording as plumb-camera would publish it: CAMERA_CALIBRATION at the beginning and
/// once a second, and CAMERA per frame, rectified and masked as the configuration says. Events
/// carry the capture times.
#pragma once

#include <cstdint>
#include <filesystem>

#include "modules/camera/camera_config.hpp"
#include "modules/camera/recorded_source.hpp"

namespace plumb {

struct RecordingOptions {
  std::filesystem::path out;
  std::filesystem::path mask_folder;  ///< a relative camera.mask_file is relative to it
  bool jpeg = false;                  ///< true: JPEG of quality 95; false: plain pixels
  std::int64_t start = 0;             ///< first frame, by its number
  std::int64_t end = -1;              ///< last frame; -1: that of the recording
};

struct RecordingResult {
  std::int64_t num_frames = 0;
  std::int64_t num_faulty = 0;  ///< frames that plumb-camera would call dark, flat or frozen
  std::int64_t log_bytes = 0;
  double duration_s = 0.0;
  int width_px = 0;
  int height_px = 0;
  bool stopped = false;  ///< by a signal; the log has the frames up to then
};

/// Shows its progress on stderr. Throws InputError for a bad frame and LogError for a log that
/// cannot be written; what was written before is a sound log either way.
RecordingResult convert_recording(RecordedSource* source, const CameraConfig& config,
                                  const RecordingOptions& options);

}  // namespace plumb
