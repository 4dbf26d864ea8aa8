#include "tools/evaluate/objects_eval/placement_command.hpp"

#include <algorithm>
#include <iostream>
#include <utility>

#include "core/input_error.hpp"
#include "modules/chain/plumb_config.hpp"
#include "platform/command_line.hpp"
#include "platform/config.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/evaluate/objects_eval/placement_report.hpp"

namespace plumb {
namespace {

const std::pair<const char*, ObjectClass> kVehicles[] = {{"car", ObjectClass::kCar},
                                                         {"van", ObjectClass::kVan},
                                                         {"truck", ObjectClass::kTruck},
                                                         {"bus", ObjectClass::kBus}};

std::vector<ObjectClass> classes_of(const std::vector<std::string>& names) {
  std::vector<ObjectClass> classes;
  for (const auto& [name, object_class] : kVehicles) {
    if (std::find(names.begin(), names.end(), name) != names.end()) classes.push_back(object_class);
  }
  return classes;
}

PlacementOptions options_of(const PlacementCommand& command) {
  PlumbConfig config;
  load_config(command.config, &config);
  PlacementOptions options;
  options.boxes = command.boxes;
  options.classes = classes_of(command.classes);
  options.objects = config.objects;
  options.calibrated_pitch_rad = config.detections.mean_pitch_rad;
  options.camera_height_m = config.ground.camera_height_m;
  return options;
}

/// @pre three files a drive
void refuse_overwriting(const PlacementCommand& command) {
  const std::vector<std::string>& files = command.files;
  OverwriteGuard guard;
  guard.reads("--config", command.config).writes("--json", command.report.json);
  for (std::size_t i = 0; i < files.size(); i += 3) {
    guard.reads_folder("DRIVE", files[i], {".txt", ".png"});
    guard.reads("FRAMES", files[i + 1]).reads("OBJECTS", files[i + 2]);
  }
  guard.check();
}

}  // namespace

CommandLine add_placement_command(CommandLine* app, PlacementCommand* command) {
  CommandLine placed = app->add_subcommand("placed",
                                           "measure how far off the whole chain placed objects: "
                                           "compare plumb-replay's tables with labels");
  placed
      .add_option("DRIVE FRAMES OBJECTS", command->files,
                  "the drive's folder (images, calib.txt, label_02.txt, perhaps poses.txt), what "
                  "plumb-replay wrote for it with --csv and with --objects; more drives may follow")
      .type_name("")
      .required();
  placed.add_option("--boxes", command->boxes, "file in DRIVE with the boxes that were replayed")
      .capture_default_str();
  placed.add_option("--classes", command->classes, "classes of the labels to take")
      .delimiter(',')
      .check(one_of({"car", "van", "truck", "bus"}))
      .capture_default_str();
  placed.add_option("--config", command->config, "settings of the replay").type_name("FILE");
  add_report_options(&placed, &command->report);
  return placed;
}

int run_placement_command(const PlacementCommand& command) {
  const std::vector<std::string>& files = command.files;
  if (files.size() % 3 != 0) {
    throw InputError("give DRIVE, FRAMES and OBJECTS for every drive; see --help");
  }
  refuse_overwriting(command);
  const PlacementOptions options = options_of(command);
  std::vector<DrivePlacement> drives;
  for (std::size_t i = 0; i < files.size(); i += 3) {
    drives.push_back(evaluate_placement(files[i], files[i + 1], files[i + 2], options));
    if (!drives.back().samples.empty()) continue;
    throw InputError(files[i + 2] + " places none of the " +
                     std::to_string(drives.back().num_labels) + " labels of " + files[i]);
  }
  std::cout << placement_table(drives);
  const ReportOptions& wanted = command.report;
  if (!wanted.json.empty()) write_placement_json(drives, wanted.json);
  if (!wanted.plots.empty()) {
    print_written(draw_placement(drives, wanted.plots, wanted.plot_format));
  }
  return 0;
}

}  // namespace plumb
