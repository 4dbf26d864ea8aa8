/// plumb-train: turns drives with truth into samples, and samples into the model that tells how far
/// each cue can be trusted.

#include <string>

#include "platform/command_line.hpp"
#include "tools/learn/train/box_samples.hpp"
#include "tools/learn/train/example_command.hpp"
#include "tools/learn/train/fit_command.hpp"
#include "tools/learn/train/sample_command.hpp"
#include "tools/support/tool_main.hpp"

namespace {

constexpr const char* kFooter = R"(Examples
  plumb-train sample 05.lcm --out 05.csv          one drive; any number at once, on any machines
  plumb-train fit *.csv --out model.toml --plots pictures
  plumb-replay 05.lcm --config my.toml --csv 05_frames.csv     my.toml: [ground] model_file = "model.toml"
  plumb-train score *.csv
  plumb-train boxes 04.lcm --out 04.boxes.csv                  for the published method: fit --boxes 04.boxes.csv
  plumb-train example 04.lcm --frame 20 --config paper.toml --json example.json

Truth comes with the log (plumb-kitti2lcm writes poses and planes into it). tools/learn/train_model does all of it.)";

std::string joined(int argc, char** argv) {
  std::string text = "plumb-train";
  for (int i = 1; i < argc; ++i) {
    const std::string part = argv[i];
    text += " " + part.substr(part.rfind('/') + 1);  // Paths mean nothing on another machine.
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  plumb::CommandLine app("Learns from drives with truth how far each cue can be trusted",
                         "plumb-train");
  app.footer(kFooter);
  app.require_subcommand(1, 1);
  plumb::SampleCommand sample_command;
  plumb::FitCommand fit_command;
  plumb::BoxesCommand boxes_command;
  plumb::ExampleCommand example_command;
  plumb::ScoreCommand score_command;
  const plumb::CommandLine sample = plumb::add_sample_command(&app, &sample_command);
  const plumb::CommandLine fit = plumb::add_fit_command(&app, &fit_command);
  plumb::add_score_command(&app, &score_command);
  const plumb::CommandLine boxes = plumb::add_boxes_command(&app, &boxes_command);
  const plumb::CommandLine example = plumb::add_example_command(&app, &example_command);
  fit_command.command_line = joined(argc, argv);
  return plumb::tool_main(&app, argc, argv, [&] {
    if (sample.parsed()) return plumb::run_sample_command(sample_command);
    if (fit.parsed()) return plumb::run_fit_command(fit_command);
    if (boxes.parsed()) return plumb::run_boxes_command(boxes_command);
    if (example.parsed()) return plumb::run_example_command(example_command);
    return plumb::run_score_command(score_command);
  });
}
