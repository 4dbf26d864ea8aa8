/// Converts a recording to an LCM log.
///
/// The log has what plumb-camera would publish: CAMERA_CALIBRATION at the beginning and once a
/// second, and CAMERA per frame, rectified and masked as the settings say. Events carry the capture
/// times.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "modules/camera/camera_config.hpp"
#include "modules/camera/recorded_source.hpp"

namespace plumb {

struct RecordingOptions {
  std::filesystem::path out;
  std::filesystem::path mask_folder;            ///< a relative camera.mask_file is relative to it
  bool jpeg = false;                            ///< true: JPEG of quality 95; false: plain pixels
  std::vector<double> vehicle_speeds_m_s = {};  ///< one per image of the recording; empty: none
  std::optional<std::int64_t> start, end;       ///< first and last frame number
};

struct RecordingResult {
  std::int64_t num_frames = 0;
  std::int64_t num_faulty = 0;  ///< frames that plumb-camera would call black, flat or frozen
  std::int64_t log_bytes = 0;
  double duration_s = 0.0;        ///< from the first frame to the last
  const char* concern = nullptr;  ///< what is doubtful about the calibration, in plain words
  bool stopped = false;           ///< by a signal; the log has the frames up to then
};

/// Shows its progress and the notes of the source on stderr. Creates the log with its first frame.
/// Throws InputError for settings that do not fit, a bad frame or a range without frames, and
/// LogError for a log that cannot be written; what was written before is a sound log either way.
/// @pre `config` is complete (RecordedSource::complete)
RecordingResult convert_recording(RecordedSource* source, const CameraConfig& config,
                                  const RecordingOptions& options);

}  // namespace plumb
