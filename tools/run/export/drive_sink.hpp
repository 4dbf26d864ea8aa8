/// A file that takes the images and results of a drive in the order of time.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tools/run/export/drive_results.hpp"

namespace plumb {

struct JpegImage {
  std::int64_t capture_us = 0;
  std::int64_t seq = 0;
  std::span<const std::uint8_t> jpeg;
};

class DriveSink {
 public:
  virtual ~DriveSink() = default;
  virtual void take_image(const JpegImage& image) = 0;
  virtual void take_frame(const FrameResult& frame) = 0;
  /// Completes the file. Throws InputError.
  virtual void close() = 0;
};

/// Reads the images of the log once more and gives every image, and then its result, to the sinks.
/// Images that are not JPEG become JPEG of quality 95. Results without an image follow in their
/// order. Shows its progress on stderr.
void export_drive(const std::string& log, const DriveResults& drive,
                  const std::vector<DriveSink*>& sinks);

}  // namespace plumb
