/// Writes the results of plumb-calibrate as text, as JSON and as a configuration for the programs.
#pragma once

#include <string>

#include "tools/learn/calibrate/lens_fit.hpp"
#include "tools/learn/calibrate/mount.hpp"

namespace plumb {

struct CalibrationReport {
  std::vector<std::string> logs;
  LensFit lens;
  Mount mount;
};

[[nodiscard]] std::string to_text(const CalibrationReport& report);
/// Throws InputError when the file cannot be written.
void write_json(const CalibrationReport& report, const std::string& path);
/// Writes the section [camera] with the observed values; values that were not observed become
/// comments.
void write_camera_config(const CalibrationReport& report, const std::string& path);

}  // namespace plumb
