/// The options --json, --plots and --plot-format that the evaluating tools share.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

struct ReportOptions {
  std::string json;   ///< file for the figures; empty: none
  std::string plots;  ///< folder for the pictures; empty: none
  std::string plot_format = "png";
};

void add_json_option(CLI::App* app, std::string* json);
/// Adds all three options.
void add_report_options(CLI::App* app, ReportOptions* options);

/// Prints "wrote FILE" for each of the files.
void print_written(const std::vector<std::filesystem::path>& files);

}  // namespace plumb
