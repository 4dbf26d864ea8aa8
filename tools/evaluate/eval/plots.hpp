/// The pictures of an evaluation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/evaluate/eval/plane_metric.hpp"
#include "tools/evaluate/eval/trajectory_report.hpp"

namespace plumb {

/// Writes NAME_trajectory per sequence, and error_by_length and error_by_speed over all, as
/// `format` (png or svg) into `folder`, which is made when missing. Returns the files. Throws
/// InputError.
std::vector<std::filesystem::path> draw_plots(const TrajectoryReport& report,
                                              const std::filesystem::path& folder,
                                              const std::string& format);

/// Writes planes: height and pitch over the frames.
std::vector<std::filesystem::path> draw_plots(const PlaneReport& report,
                                              const std::filesystem::path& folder,
                                              const std::string& format);

}  // namespace plumb
