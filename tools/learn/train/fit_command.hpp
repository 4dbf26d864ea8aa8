/// plumb-train fit: files of samples -> one model file, scores and pictures. The reduce step.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace plumb {

struct FitCommand {
  std::vector<std::string> samples;
  std::vector<std::string> hold_out;
  std::string out, start, plots, json;
  std::string plot_format = "png";
  bool plane_only = false;
  std::string command_line;  ///< for the model's origin
};

CLI::App* add_fit_command(CLI::App* app, FitCommand* command);
int run_fit_command(const FitCommand& command);

/// plumb-train score: what was reported against the truth, from samples.
struct ScoreCommand {
  std::vector<std::string> samples;
  std::string json;
};

CLI::App* add_score_command(CLI::App* app, ScoreCommand* command);
int run_score_command(const ScoreCommand& command);

}  // namespace plumb
