/// A video of a drive with the results drawn onto its images: road grid, horizon, objects, features
/// by kind, path and figures, with a key of the colours.
#pragma once

#include <memory>
#include <string>

#include "tools/run/export/drive_sink.hpp"

namespace plumb {

/// Throws InputError when the name of a video ends neither in .mp4 (H.264) nor in .avi (Motion
/// JPEG).
void check_video_name(const std::string& path);

/// The video is as long as the drive: a picture stands for as many frames as it takes until the
/// next one, 2 s at most. Throws InputError when the drive has no calibration, and later when the
/// file cannot be written.
[[nodiscard]] std::unique_ptr<DriveSink> make_video_file(const DriveResults& drive,
                                                         const std::string& path);

}  // namespace plumb
