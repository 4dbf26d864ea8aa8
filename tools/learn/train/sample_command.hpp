/// plumb-train sample: turns one log with truth into one file of samples. Any number may run at
/// once.
#pragma once

#include <cstdint>
#include <string>

#include "platform/command_line.hpp"

namespace plumb {

struct SampleCommand {
  std::string log, out, planes, drive, config;
  std::uint64_t seed = 1;
  bool again = false;
};

CommandLine add_sample_command(CommandLine* app, SampleCommand* command);
int run_sample_command(const SampleCommand& command);

}  // namespace plumb
