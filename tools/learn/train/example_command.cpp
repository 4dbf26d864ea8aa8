#include "tools/learn/train/example_command.hpp"

#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/channels.hpp"
#include "core/input_error.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/chain/chain.hpp"
#include "modules/detections/detections_wire.hpp"
#include "modules/detections/road_plane.hpp"
#include "modules/ground_paper/image_keeper.hpp"
#include "modules/ground_paper/paper_dense_cue.hpp"
#include "modules/ground_paper/paper_objects_cue.hpp"
#include "modules/vo/vo_wire.hpp"
#include "platform/bounded_decode.hpp"
#include "platform/config.hpp"
#include "platform/overwrite_guard.hpp"

namespace plumb {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kComponentNames[] = {"n1", "n3", "h"};  // in the order of PlaneComponent

Json slice_json(const Slice& slice, PlaneComponent component) {
  const GaussianDip dip = fit_gaussian(slice);
  Json json = {{"component", kComponentNames[component]}, {"x", slice.x}, {"cost", slice.f}};
  if (dip.ok) {
    json["gaussian"] = {
        {"centre", dip.centre}, {"width", dip.width}, {"depth", dip.depth}, {"offset", dip.offset}};
  }
  return json;
}

Json object_json(const Detection& detection, const PaperObject& object) {
  Json candidates = Json::array();
  for (const Candidate& candidate : detection.candidates) {
    const Eigen::Vector4d b = box_vector(candidate.box);
    candidates.push_back(
        {{"lower_edge_px", b(1)}, {"height_px", b(3)}, {"score", candidate.score}});
  }
  const MixtureComponent& g = object.component;
  return {{"candidates", candidates},
          {"confidence_px2", object.confidence_px2},
          {"gaussian",
           {{"amplitude", g.amplitude},
            {"lower_edge_px", g.mean(1)},
            {"height_px", g.mean(3)},
            {"lower_edge_var_px2", g.cov(1, 1)},
            {"height_var_px2", g.cov(3, 3)},
            {"cov_px2", g.cov(1, 3)}}}};
}

/// The two examples of one log: the first image from the wanted one on that has each.
class Examples {
 public:
  explicit Examples(const PlumbConfig& config, std::int64_t frame)
      : config_(config), frame_(frame) {}

  [[nodiscard]] bool complete() const {
    return json_.contains("slices") && json_.contains("object");
  }
  [[nodiscard]] const Json& json() const { return json_; }

  void take(const LogEvent& event) {
    if (event.channel == kCameraCalibration.name) take_calibration(event.data);
    if (event.channel == kCamera.name && images_) take_image(event.data);
    if (event.channel == kDetections.name && objects_cue_) take_detections(event.data);
  }

  /// Takes the results for the image that was taken last.
  void take_result(const FrameRecord& record) {
    if (record.seq < frame_ || json_.contains("slices") || record.vo == nullptr || !images_) return;
    if (record.plane->status != ground_plane_t::STATUS_OK ||
        from_wire(*record.vo, &vo_) != nullptr) {
      return;
    }
    const double metres_per_vo = std::exp(record.ego->log_scale);
    for (const WindowPose& pose : vo_.window) {
      const Se3 T_old_cam{pose.T_window_cam.R, metres_per_vo * pose.T_window_cam.t};
      const std::size_t place = images_->find(pose.seq);
      if (T_old_cam.t.norm() < config_.ground_paper.least_step_m || place == ImageKeeper::kNone)
        continue;
      write_slices(record.seq, images_->view(place), T_old_cam);
      return;
    }
  }

 private:
  void take_calibration(std::span<const std::uint8_t> bytes) {
    camera_calibration_t message;
    if (images_ || !decode_bounded(bytes, &message) || from_wire(message, &camera_) != nullptr)
      return;
    const PaperConfig& paper = config_.ground_paper;
    height_m_ = camera_height_of(config_.ground, camera_).height_m;
    decoder_.emplace(camera_.width_px, camera_.height_px);
    images_.emplace(camera_.width_px, camera_.height_px);
    dense_cue_.emplace(camera_,
                       region_of(camera_, paper.region_width_ratio, paper.region_height_ratio),
                       paper.rho);
    objects_cue_.emplace(config_.detections, camera_, paper.pitch_rad);
  }

  void take_image(std::span<const std::uint8_t> bytes) {
    ImageFrame frame;
    ImageView view;
    if (read_image(bytes, &frame) != nullptr || decoder_->decode(frame, &view) != nullptr) return;
    dense_cue_->take(view);
    images_->push(frame.seq, view, false);
  }

  void take_detections(std::span<const std::uint8_t> bytes) {
    detections_t message;
    if (json_.contains("object") || !decode_bounded(bytes, &message) ||
        from_wire(message, &boxes_) != nullptr || boxes_.seq < frame_) {
      return;
    }
    const PaperObject* best = nullptr;
    for (const PaperObject& object : objects_cue_->measure(boxes_, height_m_)) {
      if (!std::isfinite(object.confidence_px2)) continue;
      const auto count = [this](const PaperObject& o) {
        return boxes_.detections[o.index].candidates.size();
      };
      if (best == nullptr || count(object) > count(*best)) best = &object;
    }
    if (best == nullptr) return;
    json_["object"] = object_json(boxes_.detections[best->index], *best);
    json_["object"]["seq"] = boxes_.seq;
  }

  void write_slices(std::int64_t seq, const ImageView& old_image, const Se3& T_old_cam) {
    const PaperConfig& paper = config_.ground_paper;
    const Eigen::Vector3d n = RoadPlane{paper.pitch_rad, paper.roll_rad}.normal_cam();
    const PaperDenseMeasurement seen =
        dense_cue_->measure(old_image, T_old_cam, {n.x(), n.z(), height_m_});
    if (!seen.ok) return;
    json_["seq"] = seq;
    json_["slices"] = Json::array();
    for (const PlaneComponent along : {kH, kN1, kN3}) {
      json_["slices"].push_back(
          slice_json(dense_cue_->slice(old_image, T_old_cam, seen.z, along), along));
    }
  }

  const PlumbConfig& config_;
  std::int64_t frame_;
  Json json_;
  CameraModel camera_;
  double height_m_ = 0.0;
  std::optional<ImageDecoder> decoder_;
  std::optional<ImageKeeper> images_;
  std::optional<PaperDenseCue> dense_cue_;
  std::optional<PaperObjectsCue> objects_cue_;
  VoOutput vo_;
  DetectionFrame boxes_;
};

}  // namespace

CommandLine add_example_command(CommandLine* app, ExampleCommand* command) {
  CommandLine sub = app->add_subcommand(
      "example", "show what the published method's confidences are fitted to in one image");
  sub.add_option("LOG", command->log, "log with images, perhaps boxes with candidates").required();
  sub.add_option("--json", command->json, "slices through the cost, and scores of candidates")
      .required();
  sub.add_option("--frame", command->frame, "first image that may be shown").check(at_least(0));
  sub.add_option("--config", command->config, "TOML configuration");
  return sub;
}

int run_example_command(const ExampleCommand& command) {
  OverwriteGuard()
      .reads("LOG", command.log)
      .reads("--config", command.config)
      .writes("--json", command.json)
      .check();
  PlumbConfig config;
  load_config(command.config, &config);
  if (config.ground_mode != "paper")
    throw InputError("--config: ground.mode is not \"paper\", whose confidences these are");
  Examples examples(config, command.frame);
  Chain chain(config, 1, nullptr, [&](const FrameRecord& record) { examples.take_result(record); });
  LogReader reader(command.log);
  LogEvent event;
  while (!examples.complete() && reader.next(&event)) {
    examples.take(event);
    chain.take(event);
  }
  if (!examples.json().contains("slices"))
    throw InputError(command.log + ": no image shows the road from --frame on");
  std::ofstream file(command.json);
  file << examples.json().dump(1) << "\n";
  file.close();
  if (!file) throw InputError("cannot write " + command.json);
  std::cout << "image " << examples.json()["seq"] << "\n";
  return 0;
}

}  // namespace plumb
