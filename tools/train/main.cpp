/// plumb-train: drives with truth -> samples -> the models that tell how far each cue can be trusted.

#include <CLI/CLI.hpp>

#include "tools/support/tool_main.hpp"
#include "tools/train/sample_command.hpp"

int main(int argc, char** argv) {
  CLI::App app("Learns from drives with truth how far each cue can be trusted", "plumb-train");
  app.require_subcommand(1);
  plumb::SampleCommand sample_command;
  const CLI::App* sample = plumb::add_sample_command(&app, &sample_command);
  return plumb::tool_main(&app, argc, argv, [&] {
    (void)sample;
    return plumb::run_sample_command(sample_command);
  });
}
