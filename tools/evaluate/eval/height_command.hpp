/// `plumb-eval height` and `plumb-eval compare`.
#pragma once

#include <string>

#include "platform/command_line.hpp"
#include "tools/evaluate/eval/paired_samples.hpp"

namespace plumb {

struct HeightCommand {
  std::string poses, csv, planes, json, samples, drive;
  double height_m = 1.65;
};

CommandLine add_height_command(CommandLine* app, HeightCommand* command);
/// Returns the exit code. Throws InputError.
int run_height_command(const HeightCommand& command);

struct CompareCommand {
  std::string of_file, against_file, json;
  ComparisonOptions options;
};

CommandLine add_compare_command(CommandLine* app, CompareCommand* command);
/// Returns the exit code. Throws InputError.
int run_compare_command(const CompareCommand& command);

}  // namespace plumb
