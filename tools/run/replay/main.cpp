/// plumb-replay: runs a log through vo, ground, objects and can in one process and writes poses, a
/// table of frames, a table of objects and a CAN trace.

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>

#include "core/input_error.hpp"
#include "modules/chain/chain.hpp"
#include "modules/datasets/text.hpp"
#include "platform/can_trace.hpp"
#include "platform/clock.hpp"
#include "platform/command_line.hpp"
#include "platform/config.hpp"
#include "platform/log.hpp"
#include "platform/log_file.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/run/replay/features_csv.hpp"
#include "tools/run/replay/frame_csv.hpp"
#include "tools/run/replay/objects_csv.hpp"
#include "tools/run/replay/pose_track.hpp"
#include "tools/run/replay/summary.hpp"
#include "tools/run/replay/text_output.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/stop_flag.hpp"
#include "tools/support/tool_main.hpp"

namespace plumb {
namespace {

constexpr const char* kFooter =
    R"(The same log, configuration and seed give the same poses, CAN trace and CSV, bit for bit. Only the stage times
in the CSV differ; --no-times leaves them out. Of a damaged log, everything intact is read; each damaged place is
reported, and the exit code is 2.

Examples
  plumb-replay 05.lcm --poses 05.txt --csv 05.csv --can 05.can
  plumb-replay drive.lcm --config vehicle.toml --seed 7 --poses drive.txt)";

struct Arguments {
  std::string log, poses, csv, objects, features, can, config;
  std::uint64_t seed = 1;
  bool no_times = false;
};

/// Everything that is written while the log is read.
class Outputs {
 public:
  explicit Outputs(const Arguments& arguments)
      : with_times_(!arguments.no_times),
        poses_(arguments.poses),
        csv_(arguments.csv),
        objects_(arguments.objects),
        features_(arguments.features) {
    csv_.row(frame_csv_header(with_times_));
    objects_.row(objects_csv_header());
    features_.row(features_csv_header());
    if (arguments.can.empty()) return;
    can_.emplace(arguments.can, "can0");
    check_can();
  }

  void add(const FrameRecord& record) {
    statuses_.add(record);
    poses_.row(track_.row(record.ego));
    if (csv_.wanted()) csv_.row(frame_csv_row(record, with_times_));
    const int num_features =
        features_.wanted() && record.vo != nullptr ? record.vo->num_features : 0;
    for (int i = 0; i < num_features; ++i) features_.row(features_csv_row(*record.vo, i));
    check_can();
  }

  void add(const objects_t& objects) {
    if (!objects_.wanted()) return;
    for (const object_t& object : objects.objects) objects_.row(objects_csv_row(objects, object));
  }

  void close() {
    poses_.close();
    csv_.close();
    objects_.close();
    features_.close();
    if (can_) can_->flush();
    check_can();
  }

  [[nodiscard]] CanSink* can_sink() { return can_ ? &*can_ : nullptr; }
  [[nodiscard]] const StatusCount& statuses() const { return statuses_; }
  [[nodiscard]] std::int64_t num_can_frames() const { return can_ ? can_->num_frames() : 0; }

 private:
  void check_can() const {
    if (can_ && !can_->error().empty()) throw InputError(can_->error());
  }
  bool with_times_;
  TextOutput poses_;
  TextOutput csv_;
  TextOutput objects_;
  TextOutput features_;
  std::optional<CanTraceWriter> can_;
  PoseTrack track_;
  StatusCount statuses_;
};

/// The time that it took to read and process the log.
struct Effort {
  double wall_s = 0.0;
  double cpu_s = 0.0;
};

/// Reads the log to its end, or to a stop signal.
Effort run_log(LogReader* reader, Chain* replay) {
  const std::int64_t start_us = monotonic_us();
  const std::int64_t start_cpu_us = process_cpu_us();
  Progress progress("replaying", "frames", reader->file_bytes());
  LogEvent event;
  while (!stop_requested() && reader->next(&event)) {
    replay->take(event);
    progress.update(reader->offset_bytes(), replay->num_frames());
  }
  replay->finish();
  progress.finish(!stop_requested());
  return {1e-6 * static_cast<double>(monotonic_us() - start_us),
          1e-6 * static_cast<double>(process_cpu_us() - start_cpu_us)};
}

void print_summary(const Arguments& arguments, const Chain& replay, const Outputs& outputs,
                   const Effort& effort) {
  const auto frames = static_cast<double>(std::max<std::int64_t>(replay.num_frames(), 1));
  std::cout << format(
      "%s: %lld frames, %.1f frames/s on one thread, %.1f ms of processor time each\n",
      arguments.log.c_str(), static_cast<long long>(replay.num_frames()),
      frames / std::max(effort.wall_s, 1e-6), 1e3 * effort.cpu_s / frames);
  if (replay.num_lost() > 0) {
    std::cout << format("  %lld frames are missing by their numbers\n",
                        static_cast<long long>(replay.num_lost()));
  }
  std::cout << outputs.statuses().text() << mount_text(replay.mount())
            << height_text(replay.height()) << stage_table("vo", replay.vo_timer())
            << stage_table("ground", replay.ground_timer());
  if (!arguments.can.empty()) {
    std::cout << format("%s: %lld CAN frames\n", arguments.can.c_str(),
                        static_cast<long long>(outputs.num_can_frames()));
  }
}

/// Prints a line on stderr for everything that was wrong with the log. True when anything was.
bool report_trouble(const std::string& log, const LogReader& reader, const Chain& replay) {
  for (const std::string& problem : reader.problems())
    std::cerr << "plumb-replay: " << problem << "\n";
  const auto unlisted = reader.num_problems() - static_cast<std::int64_t>(reader.problems().size());
  if (unlisted > 0) std::cerr << "plumb-replay: " << unlisted << " further damaged places\n";
  if (replay.num_frames() == 0)
    std::cerr << "plumb-replay: " << log << " holds no image on CAMERA\n";
  if (replay.num_refused() > 0) {
    std::cerr << "plumb-replay: " << log << ": " << replay.num_refused()
              << " messages were refused, the first: " << replay.first_refusal() << "\n";
  }
  return reader.num_problems() > 0 || replay.num_frames() == 0 || replay.num_refused() > 0;
}

void refuse_overwriting(const Arguments& arguments) {
  OverwriteGuard()
      .reads("LOG", arguments.log)
      .reads("--config", arguments.config)
      .writes("--poses", arguments.poses)
      .writes("--csv", arguments.csv)
      .writes("--objects", arguments.objects)
      .writes("--features", arguments.features)
      .writes("--can", arguments.can)
      .check();
}

int run(const Arguments& arguments) {
  refuse_overwriting(arguments);
  PlumbConfig config;
  load_config(arguments.config, &config);
  LogReader reader(arguments.log);
  Outputs outputs(arguments);
  Chain replay(
      config, arguments.seed, outputs.can_sink(),
      [&outputs](const FrameRecord& record) { outputs.add(record); },
      [&outputs](const objects_t& objects) { outputs.add(objects); });
  catch_stop_signals();
  const Effort effort = run_log(&reader, &replay);
  outputs.close();
  print_summary(arguments, replay, outputs, effort);
  std::cout.flush();
  return report_trouble(arguments.log, reader, replay) ? kExitRefused : 0;
}

void add_options(CommandLine* app, Arguments* arguments) {
  app->footer(kFooter);
  app->add_option("LOG", arguments->log, "LCM log with CAMERA and CAMERA_CALIBRATION").required();
  app->add_option("--poses", arguments->poses, "KITTI pose file to write, one row per image");
  app->add_option("--csv", arguments->csv, "table to write, one row per image");
  app->add_option("--objects", arguments->objects,
                  "table to write, one row per object and image on DETECTIONS");
  app->add_option("--features", arguments->features,
                  "table to write, one row per feature and image, with its kind");
  app->add_option("--can", arguments->can, "CAN trace to write, as candump -L");
  app->add_option("--config", arguments->config, "TOML configuration");
  app->add_option("--seed", arguments->seed, "seed of the random sampling").capture_default_str();
  app->add_flag("--no-times", arguments->no_times, "leave the stage times out of the CSV");
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::set_log_name("plumb-replay");
  plumb::Arguments arguments;
  plumb::CommandLine app("Runs a log through vo, ground, objects and can in one process",
                         "plumb-replay");
  plumb::add_options(&app, &arguments);
  return plumb::tool_main(&app, argc, argv, [&] { return plumb::run(arguments); });
}
