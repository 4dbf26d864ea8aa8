/// Reports an evaluation of placed objects as figures, a table, JSON and pictures.
///
/// Units:
///   metres inside; percent of the true depth in what is printed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/evaluate/objects_eval/placement.hpp"

namespace plumb {

enum class Range { kClose, kDistant };  ///< Z* <= 10 m, and beyond
enum class Motion { kAny, kStanding, kMoving };

/// Figures over some samples; NaN without samples.
struct PlacementFigures {
  std::size_t num_samples = 0;
  double depth_mean_percent = 0.0;
  double depth_median_percent = 0.0;
  double depth_bias_percent = 0.0;  ///< mean of the signed error; positive is too far
  double position_mean_percent = 0.0;
  double position_median_percent = 0.0;
  double depth_nees =
      0.0;  ///< 1 when the standard deviations are right, more when they are too small
  double position_nees = 0.0;
  double foot_percent = 0.0;  ///< depth, foot point on the reported plane
  double foot_calibrated_percent = 0.0;
};

[[nodiscard]] PlacementFigures placement_figures(const std::vector<PlacementSample>& samples,
                                                 Range range, Motion motion);

/// All drives together, as one drive named "all".
[[nodiscard]] DrivePlacement pool(const std::vector<DrivePlacement>& drives);

[[nodiscard]] std::string placement_table(const std::vector<DrivePlacement>& drives);

/// Throws InputError when the file cannot be written.
void write_placement_json(const std::vector<DrivePlacement>& drives,
                          const std::filesystem::path& path);

/// Returns the files written. Throws InputError.
std::vector<std::filesystem::path> draw_placement(const std::vector<DrivePlacement>& drives,
                                                  const std::filesystem::path& folder,
                                                  const std::string& format);

}  // namespace plumb
