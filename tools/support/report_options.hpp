/// The options --json, --plots and --plot-format that the evaluating tools share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "platform/command_line.hpp"

namespace plumb {

struct ReportOptions {
  std::string json;   ///< file for the figures; empty: none
  std::string plots;  ///< folder for the pictures; empty: none
  std::string plot_format = "png";
};

void add_json_option(CommandLine* app, std::string* json);
/// Adds all three options.
void add_report_options(CommandLine* app, ReportOptions* options);

/// Prints "wrote FILE" for each of the files.
void print_written(const std::vector<std::filesystem::path>& files);

}  // namespace plumb
