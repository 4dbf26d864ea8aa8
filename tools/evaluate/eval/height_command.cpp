#include "tools/evaluate/eval/height_command.hpp"

#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/evaluate/eval/height_metric.hpp"
#include "tools/support/report_options.hpp"

namespace plumb {
namespace {

using HeightJson = nlohmann::ordered_json;

void write_file(const HeightJson& json, const std::string& path) {
  std::ofstream file(path);
  file << json.dump(2) << "\n";
  file.close();
  if (!file) throw InputError("cannot write " + path);
}

HeightJson to_json(const HeightErrors& errors) {
  HeightJson json;
  for (const auto& [name, list] : errors) {
    const HeightSummary summary = summarize_heights(list);
    HeightJson& entry = json[name];
    entry = {
        {"num_frames", summary.num_frames},     {"mean_percent", summary.mean_percent},
        {"bias_percent", summary.bias_percent}, {"within_7_percent_ratio", summary.within_7_ratio},
        {"frames", HeightJson::array()},        {"errors_percent", HeightJson::array()}};
    for (const HeightError& error : list) {
      entry["frames"].push_back(error.seq);
      entry["errors_percent"].push_back(error.error_percent);
    }
  }
  return json;
}

HeightJson to_json(const Interval& interval) {
  return {{"mean", interval.mean}, {"low", interval.low}, {"high", interval.high}};
}

std::string line_of(const char* name, const Interval& interval) {
  return format("%-10s %9.4f   %9.4f .. %9.4f\n", name, interval.mean, interval.low, interval.high);
}

}  // namespace

CommandLine add_height_command(CommandLine* app, HeightCommand* command) {
  CommandLine sub = app->add_subcommand("height", "compare heights by the true step");
  sub.add_option("POSES", command->poses, "true poses, 12 numbers per row").required();
  sub.add_option("EST_CSV", command->csv, "what plumb-replay wrote with --csv").required();
  sub.add_option("--planes", command->planes, "true planes [the nominal height in every frame]");
  sub.add_option("--height", command->height_m, "nominal height of the camera, m")
      .check(within(0.1, 10.0))
      .capture_default_str();
  sub.add_option("--samples", command->samples, "file for the error of every frame [%]");
  sub.add_option("--drive", command->drive, "name of the drive in that file [that of EST_CSV]");
  add_json_option(&sub, &command->json);
  return sub;
}

int run_height_command(const HeightCommand& command) {
  OverwriteGuard()
      .reads("POSES", command.poses)
      .reads("EST_CSV", command.csv)
      .reads("--planes", command.planes)
      .writes("--samples", command.samples)
      .writes("--json", command.json)
      .check();
  const auto planes =
      command.planes.empty() ? std::map<std::int64_t, TruePlane>{} : read_planes(command.planes);
  const HeightErrors errors = height_by_true_step(
      read_poses(command.poses), read_height_rows(command.csv), planes, command.height_m);
  const std::string drive =
      command.drive.empty() ? std::filesystem::path(command.csv).stem().string() : command.drive;
  std::vector<ErrorSample> samples;
  for (const auto& [name, list] : errors) {
    const HeightSummary summary = summarize_heights(list);
    std::cout << format("%-8s %6d frames  mean %7.3f %%  bias %7.3f %%  within 7 %%: %5.1f %%\n",
                        name.c_str(), summary.num_frames, summary.mean_percent,
                        summary.bias_percent, 100.0 * summary.within_7_ratio);
    for (const HeightError& error : list)
      samples.push_back({drive, error.seq, name, std::abs(error.error_percent)});
  }
  if (!command.samples.empty()) write_error_samples(samples, command.samples);
  if (!command.json.empty()) write_file(to_json(errors), command.json);
  return 0;
}

CommandLine add_compare_command(CommandLine* app, CompareCommand* command) {
  CommandLine sub = app->add_subcommand(
      "compare", "say which of two sets of errors is smaller, with a confidence interval");
  sub.add_option("SAMPLES", command->of_file, "table of drive, frame, kind, value").required();
  sub.add_option("AGAINST", command->against_file, "table of the same frames").required();
  sub.add_option("--of", command->options.of, "kind to take of SAMPLES [all, each with its like]");
  sub.add_option("--against", command->options.against, "kind to take of AGAINST");
  sub.add_option("--block", command->options.block_frames, "frames whose errors are alike")
      .check(within(1, 10000))
      .capture_default_str();
  add_json_option(&sub, &command->json);
  return sub;
}

int run_compare_command(const CompareCommand& command) {
  if (command.options.of.empty() != command.options.against.empty())
    throw InputError("--of and --against go together; see --help");
  OverwriteGuard()
      .reads("SAMPLES", command.of_file)
      .reads("AGAINST", command.against_file)
      .writes("--json", command.json)
      .check();
  const PairedComparison result =
      compare_samples(read_error_samples(command.of_file), read_error_samples(command.against_file),
                      command.options);
  std::cout << format("%d pairs in %d blocks; means and their 95 %% intervals\n", result.num_pairs,
                      result.num_blocks)
            << line_of("first", result.of) << line_of("second", result.against)
            << line_of("difference", result.difference);
  if (command.json.empty()) return 0;
  write_file({{"num_pairs", result.num_pairs},
              {"num_blocks", result.num_blocks},
              {"of", to_json(result.of)},
              {"against", to_json(result.against)},
              {"difference", to_json(result.difference)}},
             command.json);
  return 0;
}

}  // namespace plumb
