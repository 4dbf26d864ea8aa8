/// The published method's object cue beside the truth: one row per detected object, from which
/// model C_d of Algorithm 1 is fitted.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "platform/command_line.hpp"

namespace plumb {

struct BoxSample {
  double seq = 0.0;
  double confidence_px2 = 0.0;  ///< a_d; NaN without candidates
  double error_n3 = 0.0;        ///< of (9), in the image of the box
  double distance_m = 0.0;      ///< by the height of the box
};

/// Reads a file that plumb-train boxes wrote. Throws InputError.
[[nodiscard]] std::vector<BoxSample> read_box_samples(const std::filesystem::path& path);

struct BoxesCommand {
  std::string log, out, config;
};

/// plumb-train boxes: turns one log with boxes, candidates and true planes into such a file.
CommandLine add_boxes_command(CommandLine* app, BoxesCommand* command);
int run_boxes_command(const BoxesCommand& command);

}  // namespace plumb
