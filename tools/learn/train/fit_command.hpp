/// plumb-train fit: turns files of samples into one model file, scores and pictures.
#pragma once

#include <string>
#include <vector>

#include "platform/command_line.hpp"
#include "tools/support/report_options.hpp"

namespace plumb {

struct FitCommand {
  std::vector<std::string> samples;
  std::vector<std::string> boxes;
  std::vector<std::string> hold_out;
  std::string out, start;
  ReportOptions report;
  bool plane_only = false;
  std::string command_line;  ///< for the model's origin
};

CommandLine add_fit_command(CommandLine* app, FitCommand* command);
int run_fit_command(const FitCommand& command);

/// plumb-train score: compares the reported values in samples with the truth.
struct ScoreCommand {
  std::vector<std::string> samples;
  std::string json;
};

CommandLine add_score_command(CommandLine* app, ScoreCommand* command);
int run_score_command(const ScoreCommand& command);

}  // namespace plumb
