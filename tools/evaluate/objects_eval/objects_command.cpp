#include "tools/evaluate/objects_eval/objects_command.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/input_error.hpp"
#include "modules/chain/plumb_config.hpp"
#include "platform/command_line.hpp"
#include "platform/config.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/evaluate/objects_eval/object_depth.hpp"
#include "tools/support/report_options.hpp"

namespace plumb {
namespace {

std::vector<std::string> sequences_in(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".txt") names.push_back(entry.path().stem().string());
  }
  if (names.empty()) throw InputError("no label files (NNNN.txt) in " + folder.string());
  std::sort(names.begin(), names.end());
  return names;
}

/// null where there is nothing to say.
nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json to_json(const DepthErrors& errors) {
  nlohmann::json json{{"num_samples", errors.num_samples}, {"nees", number(errors.mean_nees())}};
  for (std::size_t m = 0; m < kNumMethods; ++m) {
    const auto method = static_cast<PlacementMethod>(m);
    json["methods"].push_back(
        {{"name", kMethodNames[m]},
         {"depth_error_percent", number(errors.depth_percent(method))},
         {"position_error_percent", number(errors.position_percent(method))}});
  }
  return json;
}

nlohmann::json to_json(const SequenceDepth& sequence) {
  return {{"sequence", sequence.name},
          {"num_labels", sequence.num_labels},
          {"cue_pitch_rms_rad", number(sequence.pitch_rms_rad)},
          {"close", to_json(sequence.close)},
          {"distant", to_json(sequence.distant)}};
}

void write_json(const ObjectsCommand& command, const std::vector<SequenceDepth>& sequences) {
  nlohmann::json json{{"boxes", command.boxes}, {"all", to_json(pool(sequences))}};
  for (const SequenceDepth& sequence : sequences) json["sequences"].push_back(to_json(sequence));
  std::ofstream file(command.json);
  file << json.dump(2) << "\n";
  if (!file.flush()) throw InputError("cannot write " + command.json);
}

}  // namespace

CommandLine add_objects_command(CommandLine* app, ObjectsCommand* command) {
  CommandLine objects = app->add_subcommand(
      "objects",
      "measure how far off objects are placed on KITTI tracking sequences, from boxes alone");
  objects.add_option("ROOT", command->root, "folder with calib/ and label_02/").required();
  objects.add_option("--boxes", command->boxes, "folder under ROOT with the boxes to use")
      .capture_default_str();
  objects
      .add_option("--sequence", command->sequences, "evaluate only this sequence; may be repeated")
      .type_name("NNNN");
  objects.add_option("--camera-height", command->camera_height_m, "above the road [m]")
      .check(within(0.3, 4.0))
      .capture_default_str();
  objects.add_option("--config", command->config, "settings, keys detections.* and objects.*")
      .type_name("FILE");
  add_json_option(&objects, &command->json);
  return objects;
}

int run_objects_command(const ObjectsCommand& command) {
  OverwriteGuard()
      .reads("--config", command.config)
      .reads_folder("ROOT", command.root, {".txt"})
      .writes("--json", command.json)
      .check();
  PlumbConfig config;
  load_config(command.config, &config);
  ObjectDepthOptions options;
  options.root = command.root;
  options.boxes = command.boxes;
  options.sequences = command.sequences;
  options.camera_height_m = command.camera_height_m;
  options.detections = config.detections;
  options.objects = config.objects;
  if (options.sequences.empty()) options.sequences = sequences_in(options.root / "label_02");
  const std::vector<SequenceDepth> sequences = evaluate_object_depth(options);
  std::cout << depth_table(sequences);
  if (!command.json.empty()) write_json(command, sequences);
  return 0;
}

}  // namespace plumb
