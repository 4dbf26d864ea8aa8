#include "tools/run/export/ros2_file.hpp"

#include <algorithm>
#include <cmath>

#include "core/input_error.hpp"
#include "core/pose_wire.hpp"
#include "modules/datasets/text.hpp"
#include "platform/version.hpp"
#include "tools/run/export/mcap_writer.hpp"
#include "tools/run/export/ros2_messages.hpp"
#include "tools/run/export/vehicle_frame.hpp"
#include "tools/run/replay/names.hpp"

namespace plumb {
namespace {

using ros2::Diagnosis;

// Nodes that start late still receive a message of this quality of service, as rosbag2 states it.
constexpr const char* kTransientLocal =
    "- history: 1\n  depth: 1\n  reliability: 1\n  durability: 1\n"
    "  deadline:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  liveliness: 1\n"
    "  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  avoid_ros_namespace_conventions: false\n";

std::string figure_text(double value) { return std::isfinite(value) ? format("%.6g", value) : "-"; }

double standard_deviation_of(double variance) {
  return variance >= 0.0 ? std::sqrt(variance) : kNan;
}

Diagnosis diagnosis_of(const ego_motion_t& ego) {
  Diagnosis diagnosis;
  diagnosis.name = "plumb-ground: motion";
  diagnosis.message = ego_status_name(ego.status);
  if (ego.status == ego_motion_t::STATUS_LOST) diagnosis.level = Diagnosis::kError;
  if (ego.status == ego_motion_t::STATUS_INITIALIZING ||
      ego.status == ego_motion_t::STATUS_SCALE_HELD || ego.status == ego_motion_t::STATUS_COASTING)
    diagnosis.level = Diagnosis::kWarn;
  diagnosis.values = {{"reason", vo_reason_name(ego.reason)},
                      {"reset_counter", std::to_string(ego.reset_counter)},
                      {"speed_m_s", figure_text(ego.velocity_ground_m_s[0])},
                      {"speed_std_m_s", figure_text(ego.speed_std_m_s)},
                      {"distance_m", figure_text(ego.distance_m)},
                      {"log_scale_std", figure_text(ego.log_scale_std)}};
  return diagnosis;
}

Diagnosis diagnosis_of(const ground_plane_t& plane) {
  Diagnosis diagnosis;
  diagnosis.name = "plumb-ground: road plane";
  diagnosis.message = plane_status_name(plane.status);
  if (plane.status == ground_plane_t::STATUS_INVALID) diagnosis.level = Diagnosis::kError;
  if (plane.status == ground_plane_t::STATUS_INITIALIZING) diagnosis.level = Diagnosis::kWarn;
  diagnosis.values = {
      {"reason", plane_reason_name(plane.reason)},
      {"height_m", figure_text(plane.height_m)},
      {"height_std_m", figure_text(plane.height_m * standard_deviation_of(plane.cov[2][2]))},
      {"pitch_rad", figure_text(plane.pitch_rad)},
      {"pitch_std_rad", figure_text(standard_deviation_of(plane.cov[0][0]))},
      {"roll_rad", figure_text(plane.roll_rad)},
      {"roll_std_rad", figure_text(standard_deviation_of(plane.cov[1][1]))}};
  return diagnosis;
}

Diagnosis diagnosis_of(const process_health_t& health) {
  constexpr std::int8_t kRunning = 0, kDegraded = 2;
  Diagnosis diagnosis;
  diagnosis.name = "plumb-" + health.process;
  diagnosis.message = health.state == kRunning ? "running" : health.state_reason;
  diagnosis.level = health.state == kRunning    ? Diagnosis::kOk
                    : health.state == kDegraded ? Diagnosis::kError
                                                : Diagnosis::kWarn;
  diagnosis.values = {{"num_received", std::to_string(health.num_received)},
                      {"num_rejected", std::to_string(health.num_rejected)},
                      {"num_dropped", std::to_string(health.num_dropped)},
                      {"num_late", std::to_string(health.num_late)},
                      {"num_skipped", std::to_string(health.num_skipped)},
                      {"num_published", std::to_string(health.num_published)},
                      {"memory_rss_bytes", std::to_string(health.memory_rss_bytes)}};
  return diagnosis;
}

class Ros2File : public DriveSink {
 public:
  Ros2File(const DriveResults& drive, const std::filesystem::path& path)
      : drive_(drive),
        T_vehicle_cam_(vehicle_from_camera(drive)),
        mcap_(path, "ros2", std::string("plumb-export ") + plumb_version()) {
    odometry_ = channel("/odom", schema(ros2::odometry_type()));
    image_ = channel("/camera/image/compressed", schema(ros2::compressed_image_type()));
    info_ = channel("/camera/camera_info", schema(ros2::camera_info_type()));
    const std::uint16_t transform = schema(ros2::tf_message_type());
    transforms_ = channel("/tf", transform);
    diagnostics_ = channel("/diagnostics", schema(ros2::diagnostic_array_type()));
    const std::uint16_t fixed = channel("/tf_static", transform, kTransientLocal);
    const std::int64_t start_us = drive.frames.front().capture_us;
    write(fixed, start_us, ros2::tf_message(start_us, {{"base_link", "camera", T_vehicle_cam_}}));
  }

  void take_image(const JpegImage& image) override {
    write(image_, image.capture_us, ros2::compressed_image(image.capture_us, image.jpeg));
    if (drive_.camera)
      write(info_, image.capture_us, ros2::camera_info(image.capture_us, *drive_.camera));
  }

  void take_frame(const FrameResult& frame) override {
    const std::int64_t time_us = frame.capture_us;
    std::vector<ros2::Transform> transforms;
    if (has_pose(frame)) {
      const Se3 T_world_cam = camera_pose(frame);
      const Se3 T_odom_vehicle = vehicle_pose(T_vehicle_cam_, T_world_cam);
      transforms.push_back({"odom", "base_link", T_odom_vehicle});
      Matrix6d cov_world_cam;
      if (from_wire(frame.ego->cov_world_cam, &cov_world_cam) == nullptr) {
        const auto twist = vehicle_twist(T_vehicle_cam_, frame);
        write(odometry_, time_us,
              ros2::odometry(time_us, T_odom_vehicle,
                             vehicle_pose_covariance(T_vehicle_cam_, T_world_cam, cov_world_cam),
                             twist ? &*twist : nullptr));
      }
    }
    if (has_plane(frame)) transforms.push_back({"camera", "road", camera_from_road(*frame.plane)});
    if (!transforms.empty()) write(transforms_, time_us, ros2::tf_message(time_us, transforms));

    std::vector<Diagnosis> diagnoses;
    if (frame.ego) diagnoses.push_back(diagnosis_of(*frame.ego));
    if (frame.plane) diagnoses.push_back(diagnosis_of(*frame.plane));
    for (const process_health_t& health : frame.health) diagnoses.push_back(diagnosis_of(health));
    if (!diagnoses.empty())
      write(diagnostics_, time_us, ros2::diagnostic_array(time_us, diagnoses));
  }

  void close() override { mcap_.close(); }

 private:
  std::uint16_t schema(const ros2::Type& type) {
    return mcap_.add_schema(type.name, "ros2msg", type.definition);
  }
  std::uint16_t channel(const char* topic, std::uint16_t type, const char* quality = "") {
    return mcap_.add_channel(topic, "cdr", type, {{"offered_qos_profiles", quality}});
  }
  void write(std::uint16_t topic, std::int64_t time_us, const ros2::Bytes& bytes) {
    mcap_.write(topic, 1000 * static_cast<std::uint64_t>(std::max<std::int64_t>(time_us, 0)),
                bytes);
  }

  const DriveResults& drive_;
  Se3 T_vehicle_cam_;
  McapWriter mcap_;
  std::uint16_t odometry_, image_, info_, transforms_, diagnostics_;
};

}  // namespace

std::unique_ptr<DriveSink> make_ros2_file(const DriveResults& drive,
                                          const std::filesystem::path& path) {
  return std::make_unique<Ros2File>(drive, path);
}

}  // namespace plumb
