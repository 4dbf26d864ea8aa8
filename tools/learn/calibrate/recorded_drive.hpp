/// The images of one log, decoded and kept, so that they can be run through the estimators again and again.
///
/// Memory  grey images of the whole log: 0.5 MB each at 1242 x 375.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"

namespace plumb {

struct RecordedImage {
  std::int64_t capture_us = 0;
  std::int64_t seq = 0;
  std::vector<std::uint8_t> grey;  ///< rows packed
};

struct RecordedDrive {
  std::string log;
  CameraModel camera;           ///< as the log states it
  bool has_true_poses = false;  ///< on GROUND_TRUTH
  std::vector<RecordedImage> images;

  [[nodiscard]] ImageView view(std::size_t i) const;
};

/// The first `most_images` of a log. Throws InputError, LogError; also for a log without a calibration before its images
/// or without 30 images.
[[nodiscard]] RecordedDrive read_drive(const std::string& log, std::size_t most_images);

}  // namespace plumb
