#include "tools/support/tool_main.hpp"

#include <cstdio>
#include <exception>

#include "platform/command_line.hpp"

namespace plumb {

int tool_main(CommandLine* app, int argc, char** argv, const std::function<int()>& run) {
  const std::string program = app->name();
  const int done = app->parse(argc, argv);
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
