/// plumb-train example: what the published method's confidences are fitted to in one image, as in
/// the paper's Figs 3 and 7.
#pragma once

#include <cstdint>
#include <string>

#include "platform/command_line.hpp"

namespace plumb {

struct ExampleCommand {
  std::string log, config, json;
  std::int64_t frame = 0;
};

CommandLine add_example_command(CommandLine* app, ExampleCommand* command);
int run_example_command(const ExampleCommand& command);

}  // namespace plumb
