/// The decoded images of one log, kept in memory for repeated runs of the estimators.
///
/// Memory:
///   0.5 MB per grey image of 1242 x 375 pixels.
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

/// Reads at most the first `most_images` images. Throws LogError when the log cannot be read, and
/// InputError when no calibration precedes the images or when there are fewer than 30 images.
[[nodiscard]] RecordedDrive read_drive(const std::string& log, std::size_t most_images);

}  // namespace plumb
