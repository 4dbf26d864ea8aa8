/// Figures of how a drive looks to an estimator, for comparing rendered with real drives.
///
/// Units:
///   Grey levels and pixels.
/// Road:
///   The part of the image within 1.65 m of the camera's vertical plane and nearer than 30 m, for a
///   level camera 1.65 m above a plane.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumb::synth {

struct DriveStats {
  std::string name;
  int frames = 0;
  double mean = 0.0;
  double sd = 0.0;
  double saturated_percent = 0.0;
  double gradient_median = 0.0;  ///< central differences, whole image
  double gradient_p90 = 0.0;
  double road_mean = 0.0;
  double road_gradient_median = 0.0;
  double road_gradient_p90 = 0.0;
  double road_over_8_percent = 0.0;  ///< road pixels whose gradient exceeds 8
  double spectrum_slope = 0.0;  ///< d log power / d log frequency of rows, 4..64 cycles per 256 px
  double road_spectrum_slope = 0.0;
  double noise = 0.0;                 ///< standard deviation in the smoothest blocks
  double corner_cells_percent = 0.0;  ///< 32 px cells with a corner worth tracking
  double road_corner_cells_percent = 0.0;
  double survive_5_percent = 0.0;  ///< corners still followed by Lucas-Kanade after 5 frames
  double survive_10_percent = 0.0;
};

/// Measures a folder in KITTI layout (image_0/*.png, calib.txt). Throws std::invalid_argument,
/// naming what is missing.
[[nodiscard]] DriveStats measure_drive(const std::filesystem::path& folder);

/// A table with one row per drive.
[[nodiscard]] std::string stats_table(const std::vector<DriveStats>& drives);

}  // namespace plumb::synth
