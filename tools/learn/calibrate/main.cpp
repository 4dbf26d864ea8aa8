/// plumb-calibrate: finds lens terms and mount from ordinary drives with turns, and reports what
/// could not be observed.

#include <iostream>
#include <string>
#include <vector>

#include "core/input_error.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/datasets/text.hpp"
#include "platform/command_line.hpp"
#include "platform/config.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/learn/calibrate/calibration_report.hpp"
#include "tools/support/report_options.hpp"
#include "tools/support/stop_flag.hpp"
#include "tools/support/tool_main.hpp"

namespace plumb {
namespace {

constexpr const char* kFooter = R"(Examples
  plumb-calibrate a.lcm b.lcm --out rig.toml      lens terms out of two drives with turns; then: --config rig.toml
  plumb-calibrate a.lcm --parameters k1,k2,focal  asks for the focal length, too

Logs hold CAMERA and CAMERA_CALIBRATION; true poses in them (plumb-kitti2lcm writes those) give the camera's height.
A rig's lens shows in turns: 100 images of two or more of them, left and right, are a good beginning.)";

struct Arguments {
  std::vector<std::string> logs;
  std::string parameters = "k1,k2";
  std::string config, out, json;
  std::uint64_t seed = 1;
  std::size_t most_images = 500;
};

std::vector<RecordedDrive> read_drives(const Arguments& arguments) {
  std::vector<RecordedDrive> drives;
  for (const std::string& log : arguments.logs) {
    drives.push_back(read_drive(log, arguments.most_images));
    std::cerr << format("%s: %zu images\n", log.c_str(), drives.back().images.size());
    if (!same_camera(drives.front().camera, drives.back().camera))
      throw InputError(log + ": another camera than that of " + arguments.logs.front());
  }
  return drives;
}

void refuse_overwriting(const Arguments& arguments) {
  OverwriteGuard guard;
  for (const std::string& log : arguments.logs) guard.reads("LOG", log);
  guard.reads("--config", arguments.config)
      .writes("--out", arguments.out)
      .writes("--json", arguments.json)
      .check();
}

int run(const Arguments& arguments) {
  refuse_overwriting(arguments);
  PlumbConfig config;
  load_config(arguments.config, &config);
  const auto wanted = parse_parameters(arguments.parameters);
  if (wanted.empty()) throw InputError("--parameters names none");
  catch_stop_signals();
  const std::vector<RecordedDrive> drives = read_drives(arguments);
  CalibrationReport report;
  report.logs = arguments.logs;
  LensFitOptions options;
  options.vo = config.vo;
  options.seed = arguments.seed;
  try {
    report.lens = fit_lens(drives, wanted, options,
                           [&](int num, const std::vector<double>& values, double residual_px) {
                             std::cerr << "run " << num << ":";
                             for (const double v : values) std::cerr << format(" %.5g", v);
                             std::cerr << format("  residual %.4f px\n", residual_px);
                           });
    CameraModel camera = drives.front().camera;
    for (const FittedParameter& p : report.lens.parameters) p.parameter->set(&camera, p.value);
    report.mount = find_mount(drives, camera, config, arguments.seed);
  } catch (const Stopped&) {
    std::cerr << "stopped: nothing written\n";
    return 0;
  }
  std::cout << to_text(report);
  if (!arguments.json.empty()) write_json(report, arguments.json);
  if (!arguments.out.empty()) {
    write_camera_config(report, arguments.out);
    std::cout << "wrote " << arguments.out << "\n";
  }
  return 0;
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::CommandLine app("Finds the lens terms and the mount of a camera rig from ordinary drives",
                         "plumb-calibrate");
  app.footer(plumb::kFooter);
  plumb::Arguments arguments;
  app.add_option("LOG", arguments.logs, "logs of one rig").required();
  app.add_option("--parameters", arguments.parameters,
                 "parameters to find: some of k1, k2, focal, row, with commas between them")
      .capture_default_str();
  app.add_option("--out", arguments.out, "write the found values as a configuration to FILE")
      .type_name("FILE");
  plumb::add_json_option(&app, &arguments.json);
  app.add_option("--config", arguments.config, "TOML configuration");
  app.add_option("--seed", arguments.seed, "seed of VO's random sampling").capture_default_str();
  app.add_option("--max-images", arguments.most_images, "use at most so many images of every log")
      .check(plumb::within(30, 100000))
      .capture_default_str();
  return plumb::tool_main(&app, argc, argv, [&] { return plumb::run(arguments); });
}
