/// Writes reports as JSON. Missing numbers are null.
#pragma once

#include <filesystem>

#include "tools/evaluate/eval/plane_metric.hpp"
#include "tools/evaluate/eval/trajectory_report.hpp"

namespace plumb {

/// Throws InputError when `path` cannot be written.
void write_json(const TrajectoryReport& report, const std::filesystem::path& path);
void write_json(const PlaneReport& report, const std::filesystem::path& path);

}  // namespace plumb
