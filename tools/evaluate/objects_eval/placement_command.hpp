/// The subcommand `plumb-eval placed` measures how far off the whole chain placed objects.
#pragma once

#include <string>
#include <vector>

#include "platform/command_line.hpp"
#include "tools/support/report_options.hpp"

namespace plumb {

struct PlacementCommand {
  std::vector<std::string> files;  ///< DRIVE FRAMES_CSV OBJECTS_CSV, once or more
  std::string boxes = "label_02.txt";
  std::vector<std::string> classes{"car", "van"};
  std::string config;
  ReportOptions report;
};

/// Adds the subcommand; its options fill `command`.
CommandLine add_placement_command(CommandLine* app, PlacementCommand* command);

/// Prints the table and writes JSON and plots. Returns the exit code; throws InputError and
/// ConfigError.
int run_placement_command(const PlacementCommand& command);

}  // namespace plumb
