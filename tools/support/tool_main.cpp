#include "tools/support/tool_main.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "platform/command_line.hpp"

namespace plumb {

int tool_main(CLI::App* app, int argc, char** argv, const std::function<int()>& run) {
  const std::string program = app->get_name();
  const int done = parse_command_line(*app, program.c_str(), argc, argv);
  if (done >= 0) return done;
  try {
    return run();
  } catch (const std::exception& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "%s: %s\n", program.c_str(), error.what());
    return kExitRefused;
  }
}

}  // namespace plumb
