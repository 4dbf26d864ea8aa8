#include "tools/learn/train/box_samples.hpp"

#include <cmath>
#include <fstream>
#include <iostream>
#include <optional>

#include "core/channels.hpp"
#include "core/input_error.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/chain/plumb_config.hpp"
#include "modules/datasets/text.hpp"
#include "modules/detections/detections_wire.hpp"
#include "modules/ground/types/camera_height.hpp"
#include "modules/ground_paper/paper_objects_cue.hpp"
#include "platform/bounded_decode.hpp"
#include "platform/config.hpp"
#include "platform/log_file.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/learn/train/truth_track.hpp"
#include "tools/support/csv_table.hpp"

namespace plumb {
namespace {

constexpr const char* kBoxColumns = "seq,objects_confidence,objects_error,distance_m\n";

/// Measures the objects of every image with a true plane, as the published method does.
class BoxSampler {
 public:
  BoxSampler(const PlumbConfig& config, const TruthTrack& truth) : config_(config), truth_(truth) {}

  void take_calibration(const LogEvent& event) {
    camera_calibration_t message;
    if (cue_ || !decode_bounded(event.data, &message) || from_wire(message, &camera_) != nullptr)
      return;
    height_m_ = camera_height_of(config_.ground, camera_).height_m;
    cue_.emplace(config_.detections, camera_, config_.ground_paper.pitch_rad);
  }

  /// Returns the rows of one message.
  std::string take_detections(const LogEvent& event) {
    detections_t message;
    if (!cue_ || !decode_bounded(event.data, &message) || from_wire(message, &frame_) != nullptr)
      return {};
    const TruePlane* plane = truth_.plane(frame_.seq);
    std::string rows;
    if (plane == nullptr) return rows;
    for (const PaperObject& object : cue_->measure(frame_, height_m_)) {
      const Detection& detection = frame_.detections[object.index];
      const double height_m = config_.detections.height_prior(detection.object_class).mean_m;
      const bool has_confidence = std::isfinite(object.confidence_px2);
      rows += format("%lld,%s,%.6e,%.2f\n", static_cast<long long>(frame_.seq),
                     has_confidence ? format("%.6e", object.confidence_px2).c_str() : "",
                     object.n3 - plane->normal_cam.z(),
                     height_m * camera_.fy_px / detection.box.height_px());
      ++num_rows_;
    }
    return rows;
  }
  [[nodiscard]] int num_rows() const { return num_rows_; }

 private:
  const PlumbConfig& config_;
  const TruthTrack& truth_;
  CameraModel camera_;
  std::optional<PaperObjectsCue> cue_;
  double height_m_ = 0.0;
  DetectionFrame frame_;
  int num_rows_ = 0;
};

}  // namespace

std::vector<BoxSample> read_box_samples(const std::filesystem::path& path) {
  const CsvTable table(path);
  table.require({"seq", "objects_confidence", "objects_error", "distance_m"});
  std::vector<BoxSample> samples;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    const auto value = [&](const char* column) { return table.number(row, column).value_or(kNan); };
    samples.push_back(
        {value("seq"), value("objects_confidence"), value("objects_error"), value("distance_m")});
  }
  return samples;
}

CommandLine add_boxes_command(CommandLine* app, BoxesCommand* command) {
  CommandLine sub = app->add_subcommand(
      "boxes", "turn one log with boxes and true planes into samples of the objects cue");
  sub.add_option("LOG", command->log, "log with DETECTIONS and GROUND_TRUTH").required();
  sub.add_option("--out", command->out, "file of samples to write").required();
  sub.add_option("--config", command->config, "TOML configuration");
  return sub;
}

int run_boxes_command(const BoxesCommand& command) {
  OverwriteGuard()
      .reads("LOG", command.log)
      .reads("--config", command.config)
      .writes("--out", command.out)
      .check();
  PlumbConfig config;
  load_config(command.config, &config);
  const TruthTrack truth(command.log, "");
  LogReader reader(command.log);
  BoxSampler sampler(config, truth);
  std::string rows = kBoxColumns;
  LogEvent event;
  while (reader.next(&event)) {
    if (event.channel == kCameraCalibration.name) sampler.take_calibration(event);
    if (event.channel == kDetections.name) rows += sampler.take_detections(event);
  }
  if (sampler.num_rows() == 0)
    throw InputError(command.log + ": no detected object has a true plane beside it");
  std::ofstream file(command.out);
  file << rows;
  file.close();
  if (!file) throw InputError("cannot write " + command.out);
  std::cout << command.out << ": " << sampler.num_rows() << " objects\n";
  return 0;
}

}  // namespace plumb
