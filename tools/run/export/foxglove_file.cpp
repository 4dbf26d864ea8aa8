#include "tools/run/export/foxglove_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/datasets/number_file.hpp"
#include "modules/datasets/text.hpp"
#include "platform/version.hpp"
#include "tools/run/export/foxglove_types.hpp"
#include "tools/run/export/mcap_writer.hpp"
#include "tools/run/export/vehicle_frame.hpp"
#include "tools/run/replay/frame_csv.hpp"
#include "tools/run/replay/names.hpp"

namespace plumb {
namespace {

using foxglove::Json;

constexpr std::size_t kMaxPathPoses = 2000;
constexpr foxglove::Colour kGridColour{0.47, 0.86, 0.31, 0.9};
constexpr foxglove::Colour kMeasuredColour{1.0, 0.35, 0.35, 0.45};
constexpr foxglove::Colour kPredictedColour{0.78, 0.47, 0.78, 0.35};
constexpr foxglove::Colour kWordColour{1.0, 1.0, 1.0, 1.0};

/// The columns of the table of frames: those with words, and those with numbers.
class FrameColumns {
 public:
  FrameColumns() : names_(cells(frame_csv_header(false))) {}

  [[nodiscard]] Json schema() const {
    Json properties = Json::object();
    for (const std::string_view name : names_)
      properties[std::string(name)] = {{"type", has_words(name) ? "string" : "number"}};
    return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
            {"title", "plumbline.Frame"},
            {"type", "object"},
            {"properties", properties}};
  }

  /// Cells without a value are left out.
  [[nodiscard]] Json values(const std::string& row) const {
    Json json = Json::object();
    const std::vector<std::string> row_cells = cells(row);
    for (std::size_t i = 0; i < std::min(names_.size(), row_cells.size()); ++i) {
      if (row_cells[i].empty()) continue;
      if (has_words(names_[i])) {
        json[names_[i]] = row_cells[i];
      } else if (const std::optional<double> number = parse_number(row_cells[i])) {
        json[names_[i]] = *number;
      }
    }
    return json;
  }

 private:
  static std::vector<std::string> cells(const std::string& line) {
    const std::vector<std::string_view> views = split_cells(line);
    return {views.begin(), views.end()};
  }
  static bool has_words(std::string_view name) {
    return name == "refused" || name.ends_with("_status") || name.ends_with("_reason");
  }
  std::vector<std::string> names_;
};

/// A grid on the road with lanes' width between its lines along the road.
std::vector<Eigen::Vector3d> grid_points() {
  std::vector<Eigen::Vector3d> points;
  for (const double left : {-5.4, -3.6, -1.8, 0.0, 1.8, 3.6, 5.4}) {
    points.emplace_back(2.0, left, 0.0);
    points.emplace_back(40.0, left, 0.0);
  }
  for (const double ahead : {5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0}) {
    points.emplace_back(ahead, -5.4, 0.0);
    points.emplace_back(ahead, 5.4, 0.0);
  }
  return points;
}

Json transform(std::int64_t time_us, const char* parent, const char* child, const Se3& T) {
  return {{"timestamp", foxglove::time(time_us)},
          {"parent_frame_id", parent},
          {"child_frame_id", child},
          {"translation", foxglove::vector3(T.t)},
          {"rotation", foxglove::quaternion(T.R)}};
}

Json calibration_json(const CameraModel& camera, std::int64_t time_us) {
  const double fx = camera.fx_px, fy = camera.fy_px, cx = camera.cx_px, cy = camera.cy_px;
  return {{"timestamp", foxglove::time(time_us)},
          {"frame_id", "camera"},
          {"width", camera.width_px},
          {"height", camera.height_px},
          {"distortion_model", "plumb_bob"},
          {"D", {camera.residual_k1, camera.residual_k2, 0.0, 0.0, 0.0}},
          {"K", {fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0}},
          {"R", {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}},
          {"P", {fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0}}};
}

class FoxgloveFile : public DriveSink {
 public:
  FoxgloveFile(const DriveResults& drive, const std::filesystem::path& path)
      : drive_(drive),
        T_vehicle_cam_(vehicle_from_camera(drive)),
        mcap_(path, "", std::string("plumb-export ") + plumb_version()) {
    image_ = channel("/camera/image", foxglove::compressed_image_schema());
    calibration_ = channel("/camera/calibration", foxglove::camera_calibration_schema());
    transforms_ = channel("/tf", foxglove::frame_transforms_schema());
    pose_ = channel("/pose", foxglove::pose_in_frame_schema());
    path_ = channel("/path", foxglove::poses_in_frame_schema());
    const std::uint16_t scene = schema(foxglove::scene_update_schema());
    road_ = mcap_.add_channel("/road", "json", scene);
    objects_ = mcap_.add_channel("/objects", "json", scene);
    log_ = channel("/log", foxglove::log_schema());
    frame_ = channel("/plumbline/frame", columns_.schema());
    write_once();
  }

  void take_image(const JpegImage& image) override {
    write(image_, image.capture_us,
          {{"timestamp", foxglove::time(image.capture_us)},
           {"frame_id", "camera"},
           {"data", foxglove::base64(image.jpeg)},
           {"format", "jpeg"}});
  }

  void take_frame(const FrameResult& frame) override {
    write_transforms(frame);
    write_road(frame);
    if (frame.objects) write_objects(*frame.objects);
    write_changes(frame);
    write(frame_, frame.capture_us, columns_.values(frame.csv_row));
  }

  void close() override { mcap_.close(); }

 private:
  std::uint16_t schema(const Json& json) {
    return mcap_.add_schema(json["title"].get<std::string>(), "jsonschema", json.dump());
  }
  std::uint16_t channel(const char* topic, const Json& json) {
    return mcap_.add_channel(topic, "json", schema(json));
  }
  void write(std::uint16_t topic, std::int64_t time_us, const Json& json) {
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    mcap_.write(topic, 1000 * static_cast<std::uint64_t>(std::max<std::int64_t>(time_us, 0)),
                {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }

  /// What holds for the whole drive.
  void write_once() {
    const std::int64_t start_us = drive_.frames.front().capture_us;
    if (drive_.camera) write(calibration_, start_us, calibration_json(*drive_.camera, start_us));
    std::vector<const FrameResult*> posed;
    for (const FrameResult& frame : drive_.frames) {
      if (has_pose(frame)) posed.push_back(&frame);
    }
    const std::size_t stride = posed.size() / kMaxPathPoses + 1;
    Json poses = Json::array();
    for (std::size_t i = 0; i < posed.size(); i += stride)
      poses.push_back(foxglove::pose(vehicle_pose(T_vehicle_cam_, camera_pose(*posed[i]))));
    write(path_, start_us,
          {{"timestamp", foxglove::time(start_us)}, {"frame_id", "odom"}, {"poses", poses}});
  }

  void write_transforms(const FrameResult& frame) {
    const std::int64_t time_us = frame.capture_us;
    Json all = Json::array({transform(time_us, "base_link", "camera", T_vehicle_cam_)});
    if (has_pose(frame)) {
      const Se3 T_odom_vehicle = vehicle_pose(T_vehicle_cam_, camera_pose(frame));
      all.push_back(transform(time_us, "odom", "base_link", T_odom_vehicle));
      write(pose_, time_us,
            {{"timestamp", foxglove::time(time_us)},
             {"frame_id", "odom"},
             {"pose", foxglove::pose(T_odom_vehicle)}});
    }
    if (has_plane(frame))
      all.push_back(transform(time_us, "camera", "road", camera_from_road(*frame.plane)));
    write(transforms_, time_us, {{"transforms", all}});
  }

  /// The grid vanishes with the plane.
  void write_road(const FrameResult& frame) {
    Json entities = Json::array();
    if (has_plane(frame)) {
      Json entity = foxglove::scene_entity(frame.capture_us, "road", "road");
      entity["lines"].push_back(foxglove::line_list(grid_points(), kGridColour));
      entities.push_back(entity);
    }
    write(road_, frame.capture_us, foxglove::scene(frame.capture_us, entities));
  }

  void write_objects(const objects_t& objects) {
    Json entities = Json::array();
    for (const object_t& object : objects.objects) {
      if (object.status == object_t::STATUS_NOT_LOCALISED) continue;
      const Eigen::Vector3d size_m(object.size_m);
      const Eigen::Vector3d foot_m(object.position_ground_m);
      const Eigen::AngleAxisd heading(object.yaw_rad, Eigen::Vector3d::UnitZ());
      const Se3 centre{heading.toRotationMatrix(),
                       foot_m + Eigen::Vector3d(0.0, 0.0, 0.5 * size_m.z())};
      Json entity =
          foxglove::scene_entity(objects.utime, "road", format("object %d", object.track_id));
      entity["cubes"].push_back(foxglove::cube(
          centre, size_m,
          object.status == object_t::STATUS_MEASURED ? kMeasuredColour : kPredictedColour));
      entity["texts"].push_back(
          foxglove::text(foot_m + Eigen::Vector3d(0.0, 0.0, size_m.z() + 0.4),
                         format("%s %d, %.0f m", object_class_name(object.class_id),
                                object.track_id, std::hypot(foot_m.x(), foot_m.y())),
                         kWordColour));
      entities.push_back(entity);
    }
    write(objects_, objects.utime, foxglove::scene(objects.utime, entities));
  }

  void write_changes(const FrameResult& frame) {
    if (frame.ego) {
      const ego_motion_t& ego = *frame.ego;
      const bool is_reset = last_.reset_counter && *last_.reset_counter != ego.reset_counter;
      if (is_reset) write_log(frame, kWarning, "the integrated pose is discontinuous");
      last_.reset_counter = ego.reset_counter;
      write_change(frame, "motion", ego_status_name(ego.status), vo_reason_name(ego.reason),
                   ego.status == ego_motion_t::STATUS_LOST, &last_.motion);
    }
    if (frame.plane) {
      write_change(frame, "road plane", plane_status_name(frame.plane->status),
                   plane_reason_name(frame.plane->reason),
                   frame.plane->status == ground_plane_t::STATUS_INVALID, &last_.plane);
    }
  }

  void write_change(const FrameResult& frame, const char* what, const std::string& status,
                    const char* reason, bool is_error, std::string* last) {
    if (status == *last) return;
    *last = status;
    const int level = is_error ? kError : status == "ok" ? kInfo : kWarning;
    write_log(frame, level, format("%s: %s, reason: %s", what, status.c_str(), reason));
  }

  void write_log(const FrameResult& frame, int level, const std::string& message) {
    write(log_, frame.capture_us,
          {{"timestamp", foxglove::time(frame.capture_us)},
           {"level", level},
           {"message", message},
           {"name", "plumb-ground"},
           {"file", ""},
           {"line", 0}});
  }

  static constexpr int kInfo = 2, kWarning = 3, kError = 4;  // foxglove.LogLevel

  const DriveResults& drive_;
  Se3 T_vehicle_cam_;
  McapWriter mcap_;
  FrameColumns columns_;
  std::uint16_t image_, calibration_, transforms_, pose_, path_, road_, objects_, log_, frame_;
  struct {
    std::optional<int> reset_counter;
    std::string motion, plane;
  } last_;
};

}  // namespace

std::unique_ptr<DriveSink> make_foxglove_file(const DriveResults& drive,
                                              const std::filesystem::path& path) {
  return std::make_unique<FoxgloveFile>(drive, path);
}

}  // namespace plumb
