/// plumb-synth: renders a drive with exact truth into a folder.
#include <atomic>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include "platform/command_line.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/tool_main.hpp"
#include "tools/synth/options.hpp"
#include "tools/synth/stats.hpp"
#include "tools/synth/writer.hpp"

namespace {

std::atomic<bool> g_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free);
void on_signal(int /*signal*/) { g_stop = true; }

int list_routes() {
  for (const auto& [name, text] : plumb::synth::builtin_routes())
    std::printf("%-12s %s\n", name.c_str(), text.c_str());
  return 0;
}

int print_stats(const std::vector<std::string>& folders) {
  std::vector<plumb::synth::DriveStats> drives;
  for (const std::string& folder : folders) drives.push_back(plumb::synth::measure_drive(folder));
  std::fputs(plumb::synth::stats_table(drives).c_str(), stdout);
  return 0;
}

int render(plumb::synth::Options& options) {
  plumb::synth::complete(options);
  plumb::synth::refuse_overwriting(options.config);
  const plumb::synth::Studio studio(options.config);
  plumb::synth::prepare_folder(options.config.out, options.force);
  const int frames = studio.num_frames();
  plumb::Progress bar("rendering", "frames", frames);
  const auto progress = [&](int done) {
    if (!options.quiet) bar.update(done, done);
  };
  const plumb::synth::WriteResult result =
      plumb::synth::write_drive(studio, options.threads, g_stop, progress);
  if (options.quiet) return 0;
  bar.finish(result.frames == frames);
  std::printf("%s: %d frames in %.1f s, %.1f per second\n", options.config.out.c_str(),
              result.frames, result.seconds, result.frames / result.seconds);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  plumb::CommandLine app{"Renders drives with exact truth, in KITTI odometry layout",
                         "plumb-synth"};
  plumb::synth::Options options;
  bool list = false;
  app.add_flag("--list-routes", list, "list the built-in routes, then exit");
  plumb::synth::declare(app, options);
  std::vector<std::string> folders;
  plumb::CommandLine stats = app.add_subcommand(
      "stats",
      "print a table of how drives look to an estimator, to compare rendered with real ones");
  stats.add_option("DIR", folders, "folders in KITTI odometry layout").required();
  return plumb::tool_main(&app, argc, argv, [&] {
    if (list) return list_routes();
    return stats.parsed() ? print_stats(folders) : render(options);
  });
}
