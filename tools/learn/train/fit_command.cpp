#include "tools/learn/train/fit_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <fstream>
#include <iostream>

#include "core/input_error.hpp"
#include "modules/chain/model_file_source.hpp"
#include "tools/learn/train/fit_report.hpp"

namespace plumb {
namespace {

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &utc);
  return text;
}

std::vector<DriveSamples> read(const std::vector<std::string>& names) {
  return read_all_samples({names.begin(), names.end()});
}

/// The drives to fit: all but the named ones.
std::vector<DriveSamples> without(const std::vector<DriveSamples>& drives,
                                  const std::vector<std::string>& held_out) {
  std::vector<DriveSamples> rest;
  for (const std::string& name : held_out) {
    const auto is_it = [&name](const DriveSamples& d) { return d.drive == name; };
    if (std::none_of(drives.begin(), drives.end(), is_it))
      throw InputError("--hold-out: there is no drive " + name + " among the samples");
  }
  for (const DriveSamples& drive : drives) {
    if (std::find(held_out.begin(), held_out.end(), drive.drive) == held_out.end())
      rest.push_back(drive);
  }
  if (rest.empty()) throw InputError("--hold-out leaves no drive to fit");
  return rest;
}

void write_models(const TrainedModels& models, const std::string& path) {
  std::ofstream file(path);
  file << models_text(models);
  file.close();
  if (!file) throw InputError("cannot write " + path);
  (void)load_models(path);  // a number outside its range must show here, not in a vehicle
}

void add_origin(const FitCommand& command, const std::vector<DriveSamples>& drives,
                GroundModel* model) {
  std::string names;
  for (const DriveSamples& drive : drives) names += (names.empty() ? "" : " ") + drive.drive;
  if (drives.front().algorithm == "paper") {
    model->origin.drives += "; paper: " + names;
  } else if (command.plane_only) {
    model->origin.drives += "; plane: " + names;
  } else {
    model->origin.drives = names;
  }
  model->origin.command =
      (command.plane_only ? model->origin.command + "; " : "") + command.command_line;
  model->origin.date = today();
}

void fit_learned(const FitCommand& command, const std::vector<DriveSamples>& all,
                 const std::vector<DriveSamples>& drives, FitReport* report) {
  const GroundModel start = report->models.ground;
  const auto targets = command.plane_only ? std::span<const Target>(kPlaneTargets) : kTargets;
  if (all.size() > 1) report->held_out = leave_one_out(all, start, targets);
  report->models.ground = fit_targets(drives, start, targets);
  if (command.plane_only) return;
  fit_scale_bias(drives, &report->models.ground);
  report->objects = fit_objects(drives, &report->models.ground);
}

}  // namespace

CLI::App* add_fit_command(CLI::App* app, FitCommand* command) {
  CLI::App* sub = app->add_subcommand("fit", "files of samples -> one model file");
  sub->add_option("SAMPLES", command->samples, "files that plumb-train sample wrote")->required();
  sub->add_option("--out", command->out, "model file to write")->required();
  sub->add_option("--start", command->start,
                  "model that gives what these samples say nothing about [the built-in one]");
  sub->add_option("--hold-out", command->hold_out, "drives to score, not to fit; may be repeated")
      ->take_all();
  sub->add_flag("--plane-only", command->plane_only,
                "keep the cues' models: fit what the reported plane adds to them");
  sub->add_option("--json", command->json, "write model and scores to FILE")->type_name("FILE");
  sub->add_option("--plots", command->plots, "draw pictures into DIR")->type_name("DIR");
  sub->add_option("--plot-format", command->plot_format, "png or svg")
      ->check(CLI::IsMember({"png", "svg"}))
      ->capture_default_str();
  return sub;
}

int run_fit_command(const FitCommand& command) {
  const std::vector<DriveSamples> all = read(command.samples);
  const std::vector<DriveSamples> drives = without(all, command.hold_out);
  FitReport report;
  report.models = load_models(command.start);
  if (all.front().algorithm == "paper") {
    report.paper = fit_paper(drives, &report.models.paper);
    std::cout << to_text(report.paper);
  } else {
    fit_learned(command, all, drives, &report);
    std::cout << to_text(report.held_out);
    if (report.objects) std::cout << to_text({*report.objects});
  }
  report.outputs = score_outputs(all);
  report.cues = score_cues(all);
  std::cout << to_text(report.outputs) << to_text(report.cues);
  add_origin(command, drives, &report.models.ground);
  write_models(report.models, command.out);
  if (!command.json.empty()) write_json(report, command.json);
  if (!command.plots.empty()) {
    for (const auto& file : draw_fit(drives, report, command.plots, command.plot_format))
      std::cout << "wrote " << file.string() << "\n";
  }
  std::cout << "wrote " << command.out << "\n";
  return 0;
}

CLI::App* add_score_command(CLI::App* app, ScoreCommand* command) {
  CLI::App* sub = app->add_subcommand("score", "what was reported against truth, out of samples");
  sub->add_option("SAMPLES", command->samples, "files that plumb-train sample wrote")->required();
  sub->add_option("--json", command->json, "write the figures to FILE")->type_name("FILE");
  return sub;
}

int run_score_command(const ScoreCommand& command) {
  FitReport report;
  const std::vector<DriveSamples> drives = read(command.samples);
  report.outputs = score_outputs(drives);
  report.cues = score_cues(drives);
  std::cout << to_text(report.outputs) << to_text(report.cues);
  if (!command.json.empty()) write_json(report, command.json);
  return 0;
}

}  // namespace plumb
