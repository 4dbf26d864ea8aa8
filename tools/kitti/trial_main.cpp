/// plumb-trial: perturbs a drive as field conditions do, and takes the truth out of its log.

#include <iostream>

#include "modules/datasets/text.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/kitti/log_trial.hpp"
#include "tools/support/tool_main.hpp"

namespace {

constexpr const char* kFooter =
    R"(LOG is what plumb-kitti2lcm wrote. --poses and --planes have a row per image that is left.

Examples
  plumb-trial 04.lcm --poses truth.txt --planes planes.txt
  plumb-trial 04.lcm --skip 7 --noise 2 --drop 0.02 --seed 3 --out trial3.lcm --poses truth3.txt)";

int run(const plumb::TrialOptions& options) {
  plumb::OverwriteGuard()
      .reads("LOG", options.log)
      .writes("--out", options.out)
      .writes("--poses", options.poses)
      .writes("--planes", options.planes)
      .check();
  const plumb::TrialResult result = plumb::make_trial(options);
  std::cout << plumb::format(
      "%lld images, %lld poses, %lld planes\n", static_cast<long long>(result.num_images),
      static_cast<long long>(result.num_poses), static_cast<long long>(result.num_planes));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  plumb::TrialOptions options;
  plumb::CommandLine app("Perturbs a drive's log and takes the truth out of it", "plumb-trial");
  app.footer(kFooter);
  app.add_option("LOG", options.log, "log with images and truth").required();
  app.add_option("--out", options.out, "log to write");
  app.add_option("--poses", options.poses, "KITTI pose file to write, when every image has a pose");
  app.add_option("--planes", options.planes, "true planes to write, when there are some");
  app.add_option("--skip", options.skip, "images to leave out at the beginning")
      .check(plumb::within(0, 100000))
      .capture_default_str();
  app.add_option("--noise", options.noise, "noise on the pixels, grey levels")
      .check(plumb::within(0.0, 50.0))
      .capture_default_str();
  app.add_option("--drop", options.drop, "share of the images that are missing")
      .check(plumb::within(0.0, 0.9))
      .capture_default_str();
  app.add_option("--seed", options.seed, "seed of everything random").capture_default_str();
  return plumb::tool_main(&app, argc, argv, [&] { return run(options); });
}
