/// plumb-eval: measures how far an estimated trajectory, estimated ground planes or placed objects
/// are from the truth.

#include <iostream>
#include <string>

#include "core/input_error.hpp"
#include "modules/datasets/number_file.hpp"
#include "modules/datasets/text.hpp"
#include "platform/command_line.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/evaluate/eval/height_command.hpp"
#include "tools/evaluate/eval/plots.hpp"
#include "tools/evaluate/eval/report_json.hpp"
#include "tools/evaluate/eval/report_text.hpp"
#include "tools/evaluate/objects_eval/objects_command.hpp"
#include "tools/evaluate/objects_eval/placement_command.hpp"
#include "tools/support/report_options.hpp"
#include "tools/support/tool_main.hpp"

namespace plumb {
namespace {

constexpr const char* kFooter = R"(Examples
  plumb-eval poses/05.txt out/05.txt                     KITTI metric, 100..800 m
  plumb-eval poses/05.txt out/05.txt --lengths 10,20,50  for a short drive
  plumb-eval --gt-dir poses --est-dir out --json all.json --plots pictures
  plumb-eval plane gt_ground_plane_velodyne.txt out/04.csv
  plumb-eval height poses/04.txt out/04.csv              height by the true step
  plumb-eval compare a/heights.csv b/heights.csv --of fused --against fused
  plumb-eval objects kitti/tracking --boxes det2d/CIWT   from boxes alone
  plumb-eval placed drive0009 frames.csv objects.csv     whole chain

The metric compares relative poses only: neither file need begin with the identity.)";

struct Arguments {
  std::string gt, est, gt_dir, est_dir;
  std::string plane_gt, plane_est;
  std::string lengths = "new";
  std::string samples;
  ReportOptions report;
  EvalOptions options;
};

std::vector<double> parse_lengths(const std::string& text) {
  if (text == "new") return new_kitti_lengths_m();
  if (text == "old") return old_kitti_lengths_m();
  std::vector<double> lengths_m;
  for (const std::string_view cell : split_cells(text)) {
    const std::optional<double> value = parse_number(cell);
    if (!value || *value <= 0.0) {
      throw InputError("--lengths: '" + std::string(cell) +
                       "' is neither new, old nor a length above zero");
    }
    lengths_m.push_back(*value);
  }
  return lengths_m;
}

template <typename Report>
void give_out(const Arguments& arguments, const Report& report) {
  std::cout << to_text(report);
  const ReportOptions& wanted = arguments.report;
  if (!wanted.json.empty()) write_json(report, wanted.json);
  if (!wanted.plots.empty()) {
    print_written(draw_plots(report, wanted.plots, wanted.plot_format));
  }
}

/// Translation errors of every segment [%], of the kind of its length.
std::vector<ErrorSample> samples_of(const std::vector<SequenceReport>& sequences) {
  std::vector<ErrorSample> samples;
  for (const SequenceReport& sequence : sequences) {
    for (const SegmentError& segment : sequence.segments) {
      samples.push_back({sequence.name, segment.first_frame, format("%g", segment.length_m),
                         100.0 * segment.t_ratio});
    }
  }
  return samples;
}

int evaluate_trajectories(Arguments arguments) {
  const bool pair = !arguments.gt.empty() && !arguments.est.empty();
  const bool folders = !arguments.gt_dir.empty() && !arguments.est_dir.empty();
  if (pair == folders) {
    throw InputError("give either GT and EST, or --gt-dir and --est-dir; see --help");
  }
  OverwriteGuard()
      .reads("GT", arguments.gt)
      .reads("EST", arguments.est)
      .reads_folder("--gt-dir", arguments.gt_dir, {".txt"})
      .reads_folder("--est-dir", arguments.est_dir, {".txt"})
      .writes("--json", arguments.report.json)
      .writes("--samples", arguments.samples)
      .check();
  arguments.options.metric.lengths_m = parse_lengths(arguments.lengths);
  std::vector<SequenceReport> sequences;
  if (folders) {
    sequences = evaluate_folders(arguments.gt_dir, arguments.est_dir, arguments.options);
  } else {
    const std::string name = std::filesystem::path(arguments.est).stem().string();
    sequences = {evaluate_sequence(name, arguments.gt, arguments.est, arguments.options)};
  }
  if (!arguments.samples.empty()) write_error_samples(samples_of(sequences), arguments.samples);
  give_out(arguments, pool(std::move(sequences), arguments.options));
  return 0;
}

int evaluate_planes(const Arguments& arguments) {
  OverwriteGuard()
      .reads("GT_PLANE", arguments.plane_gt)
      .reads("EST_CSV", arguments.plane_est)
      .writes("--json", arguments.report.json)
      .check();
  const PlaneReport report =
      compare_planes(read_planes(arguments.plane_gt), read_estimate_csv(arguments.plane_est));
  if (report.num_compared == 0) {
    throw InputError("no frame of " + arguments.plane_est +
                     " has both an estimate and a plane in " + arguments.plane_gt);
  }
  give_out(arguments, report);
  return 0;
}

CommandLine add_options(CommandLine* app, Arguments* arguments) {
  app->footer(kFooter);
  app->require_subcommand(0, 1);
  app->add_option("GT", arguments->gt, "true poses, 12 numbers per row");
  app->add_option("EST", arguments->est, "estimated poses");
  app->add_option("--gt-dir", arguments->gt_dir, "folder of true poses, NAME.txt each");
  app->add_option("--est-dir", arguments->est_dir, "folder of estimates under the same names");
  app->add_option("--lengths", arguments->lengths,
                  "segment lengths [m]: new (100,200..800), old (5,10,50,100,150..400), or a list")
      .capture_default_str();
  app->add_option("--step", arguments->options.metric.step_frames,
                  "frames from one segment's start to the next one's")
      .check(within(1, 1000))
      .capture_default_str();
  app->add_option("--scale-window", arguments->options.scale_window_m,
                  "true path per window of the scale ratio [m]")
      .check(within(1.0, 1000.0))
      .capture_default_str();
  app->add_flag("--allow-partial", arguments->options.allow_partial,
                "compare the rows both files have when their number differs");
  app->add_option("--samples", arguments->samples,
                  "file for the translation error of every segment [%]");
  add_report_options(app, &arguments->report);
  CommandLine plane = app->add_subcommand("plane", "compare ground planes instead");
  plane.add_option("GT_PLANE", arguments->plane_gt, "rows: frame nx ny nz height_m ...").required();
  plane.add_option("EST_CSV", arguments->plane_est, "what plumb-replay wrote with --csv")
      .required();
  add_report_options(&plane, &arguments->report);
  return plane;
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::Arguments arguments;
  plumb::CommandLine app(
      "Measures errors of trajectories, ground planes and objects against the truth", "plumb-eval");
  const plumb::CommandLine plane = plumb::add_options(&app, &arguments);
  plumb::HeightCommand height_command;
  const plumb::CommandLine height = plumb::add_height_command(&app, &height_command);
  plumb::CompareCommand compare_command;
  const plumb::CommandLine compare = plumb::add_compare_command(&app, &compare_command);
  plumb::ObjectsCommand objects_command;
  const plumb::CommandLine objects = plumb::add_objects_command(&app, &objects_command);
  plumb::PlacementCommand placement_command;
  const plumb::CommandLine placed = plumb::add_placement_command(&app, &placement_command);
  return plumb::tool_main(&app, argc, argv, [&] {
    if (height.parsed()) return plumb::run_height_command(height_command);
    if (compare.parsed()) return plumb::run_compare_command(compare_command);
    if (placed.parsed()) return plumb::run_placement_command(placement_command);
    if (objects.parsed()) return plumb::run_objects_command(objects_command);
    return plane.parsed() ? plumb::evaluate_planes(arguments)
                          : plumb::evaluate_trajectories(arguments);
  });
}
