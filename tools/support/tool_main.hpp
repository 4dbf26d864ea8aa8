/// The command-line shell that the offline tools share: exit codes, --version, one sentence per
/// error.
#pragma once

#include <functional>

#include "platform/command_line.hpp"
#include "platform/exit_code.hpp"

namespace plumb {

/// Adds --version to `app`, parses, then calls `run`. Returns what the process should exit with: 0,
/// what `run` returned, or 2 after printing one sentence to stderr for wrong options and for any
/// std::exception, which the tools throw for wrong input (InputError) and files that cannot be read
/// or written (LogError).
int tool_main(CommandLine* app, int argc, char** argv, const std::function<int()>& run);

}  // namespace plumb
