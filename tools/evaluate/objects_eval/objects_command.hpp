/// The subcommand `plumb-eval objects` measures how far off objects are placed on KITTI tracking
/// sequences.
#pragma once

#include <string>
#include <vector>

#include "platform/command_line.hpp"

namespace plumb {

struct ObjectsCommand {
  std::string root;
  std::string boxes = "label_02";
  std::vector<std::string> sequences;  ///< empty: every file in label_02
  double camera_height_m = 1.65;
  std::string config;
  std::string json;
};

/// Adds the subcommand; its options fill `command`.
CommandLine add_objects_command(CommandLine* app, ObjectsCommand* command);

/// Prints the table and writes the JSON. Returns the exit code; throws InputError and ConfigError.
int run_objects_command(const ObjectsCommand& command);

}  // namespace plumb
