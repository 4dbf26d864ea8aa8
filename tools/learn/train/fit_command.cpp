#include "tools/learn/train/fit_command.hpp"
#include "platform/command_line.hpp"
#include "platform/overwrite_guard.hpp"

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

std::vector<BoxSample> read_all_boxes(const std::vector<std::string>& names) {
  std::vector<BoxSample> all;
  for (const std::string& name : names) {
    const std::vector<BoxSample> boxes = read_box_samples(name);
    all.insert(all.end(), boxes.begin(), boxes.end());
  }
  return all;
}

OverwriteGuard guard_samples(const std::vector<std::string>& samples) {
  OverwriteGuard guard;
  for (const std::string& file : samples) guard.reads("SAMPLES", file);
  return guard;
}

void write_models(const TrainedModels& models, const std::string& path) {
  std::ofstream file(path);
  file << models_text(models);
  file.close();
  if (!file) throw InputError("cannot write " + path);
  (void)load_models(path);  // A number outside its range is found here and not in a vehicle.
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

CommandLine add_fit_command(CommandLine* app, FitCommand* command) {
  CommandLine sub = app->add_subcommand("fit", "fit a model file to files of samples");
  sub.add_option("SAMPLES", command->samples, "files that plumb-train sample wrote").required();
  sub.add_option("--out", command->out, "model file to write").required();
  sub.add_option("--start", command->start,
                 "model for everything that these samples do not determine [the built-in one]");
  sub.add_option("--boxes", command->boxes,
                 "file that plumb-train boxes wrote, for samples of the published method; may be "
                 "repeated")
      .take_all();
  sub.add_option("--hold-out", command->hold_out, "drive to score but not to fit; may be repeated")
      .take_all();
  sub.add_flag("--plane-only", command->plane_only,
               "keep the models of the cues and fit what the reported plane adds");
  add_report_options(&sub, &command->report);
  return sub;
}

int run_fit_command(const FitCommand& command) {
  guard_samples(command.samples)
      .reads("--start", command.start)
      .writes("--out", command.out)
      .writes("--json", command.report.json)
      .check();
  const std::vector<DriveSamples> all = read(command.samples);
  const std::vector<DriveSamples> drives = without(all, command.hold_out);
  FitReport report;
  report.models = load_models(command.start);
  if (all.front().algorithm == "paper") {
    report.paper = fit_paper(drives, &report.models.paper);
    if (auto objects = fit_paper_objects(read_all_boxes(command.boxes), &report.models.paper))
      report.paper.push_back(std::move(*objects));
    std::cout << to_text(report.paper);
  } else {
    if (!command.boxes.empty())
      throw InputError("--boxes: the samples are not of the published method");
    fit_learned(command, all, drives, &report);
    std::cout << to_text(report.held_out);
    if (report.objects) std::cout << to_text({*report.objects});
  }
  report.outputs = score_outputs(all);
  report.cues = score_cues(all);
  std::cout << to_text(report.outputs) << to_text(report.cues);
  add_origin(command, drives, &report.models.ground);
  write_models(report.models, command.out);
  const ReportOptions& wanted = command.report;
  if (!wanted.json.empty()) write_json(report, wanted.json);
  if (!wanted.plots.empty()) {
    print_written(draw_fit(drives, report, wanted.plots, wanted.plot_format));
  }
  std::cout << "wrote " << command.out << "\n";
  return 0;
}

CommandLine add_score_command(CommandLine* app, ScoreCommand* command) {
  CommandLine sub =
      app->add_subcommand("score", "compare the reported values in samples with the truth");
  sub.add_option("SAMPLES", command->samples, "files that plumb-train sample wrote").required();
  add_json_option(&sub, &command->json);
  return sub;
}

int run_score_command(const ScoreCommand& command) {
  guard_samples(command.samples).writes("--json", command.json).check();
  FitReport report;
  const std::vector<DriveSamples> drives = read(command.samples);
  report.outputs = score_outputs(drives);
  report.cues = score_cues(drives);
  std::cout << to_text(report.outputs) << to_text(report.cues);
  if (!command.json.empty()) write_json(report, command.json);
  return 0;
}

}  // namespace plumb
