#include "tools/learn/train/sample_command.hpp"

#include <filesystem>
#include <iostream>

#include "core/input_error.hpp"
#include "modules/chain/chain.hpp"
#include "modules/datasets/text.hpp"
#include "modules/vo/vo_wire.hpp"
#include "platform/command_line.hpp"
#include "platform/config.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/learn/train/sample_file.hpp"
#include "tools/learn/train/sampler.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/stop_flag.hpp"

namespace plumb {
namespace {

/// Hands every frame of the log to `sampler`. False when a signal stopped it.
bool run_log(const SampleCommand& command, const PlumbConfig& config, Sampler* sampler) {
  LogReader reader(command.log);
  const Chain* chain = nullptr;
  VoOutput vo;
  Chain replay(config, command.seed, nullptr, [&](const FrameRecord& record) {
    const GroundNode& ground = chain->ground();
    if (record.vo == nullptr || record.plane == nullptr || ground.output() == nullptr) return;
    if (from_wire(*record.vo, &vo) != nullptr) return;
    sampler->add({&vo, ground.diagnostics(), ground.output(), record.plane, record.ego});
  });
  chain = &replay;
  Progress progress("sampling", "frames", reader.file_bytes());
  LogEvent event;
  while (!stop_requested() && reader.next(&event)) {
    replay.take(event);
    progress.update(reader.offset_bytes(), replay.num_frames());
  }
  progress.finish(!stop_requested());
  if (reader.num_problems() > 0) throw InputError(reader.problems().front());
  if (replay.num_refused() > 0) throw InputError(command.log + ": " + replay.first_refusal());
  return !stop_requested();
}

}  // namespace

CommandLine add_sample_command(CommandLine* app, SampleCommand* command) {
  CommandLine sub = app->add_subcommand("sample", "turn one log with truth into a file of samples");
  sub.add_option("LOG", command->log, "log with CAMERA, CAMERA_CALIBRATION and GROUND_TRUTH")
      .required();
  sub.add_option("--out", command->out, "file of samples to write").required();
  sub.add_option("--planes", command->planes,
                 "true planes, rows 'frame nx ny nz height_m ...' [those in the log]");
  sub.add_option("--drive", command->drive, "name of the drive [the log's]");
  sub.add_option("--config", command->config, "TOML configuration");
  sub.add_option("--seed", command->seed, "seed of the random sampling").capture_default_str();
  sub.add_flag("--again", command->again, "replace a file that is newer than the log");
  return sub;
}

int run_sample_command(const SampleCommand& command) {
  namespace fs = std::filesystem;
  DriveSamples samples;
  samples.drive = command.drive.empty() ? fs::path(command.log).stem().string() : command.drive;
  if (!is_drive_name(samples.drive))
    throw InputError("--drive: '" + samples.drive + "' holds more than letters, digits and ._-+");
  std::error_code error;
  if (!command.again && fs::exists(command.out, error) &&
      fs::last_write_time(command.out, error) > fs::last_write_time(command.log, error)) {
    (void)read_samples(command.out);
    std::cout << command.out << " exists already; --again replaces it\n";
    return 0;
  }
  OverwriteGuard()
      .reads("LOG", command.log)
      .reads("--planes", command.planes)
      .reads("--config", command.config)
      .writes("--out", command.out)
      .check();
  PlumbConfig config;
  load_config(command.config, &config);
  samples.algorithm = config.ground_mode == "paper" ? "paper" : config.ground.covariance;
  const TruthTrack truth(command.log, command.planes);
  Sampler sampler(&truth, config.ground.camera_height_m);
  catch_stop_signals();
  if (!run_log(command, config, &sampler)) return 0;
  samples.frames = sampler.take();
  if (samples.frames.empty())
    throw InputError(command.log + ": no frame has both truth and an estimate");
  write_samples(samples, command.out);
  std::cout << format("%s: %zu samples of %s\n", command.out.c_str(), samples.frames.size(),
                      samples.drive.c_str());
  return 0;
}

}  // namespace plumb
