/// CAMERA, CAMERA_CALIBRATION, VO_MOTION -> ground plane, scale, metric motion -> GROUND_PLANE, EGO_MOTION, MOUNT
#include <filesystem>
#include <optional>

#include "modules/config.hpp"
#include "modules/ground/ground_model_source.hpp"
#include "modules/ground/ground_node.hpp"
#include "modules/ground/mount_check.hpp"
#include "modules/ground/mount_source.hpp"
#include "platform/clock.hpp"
#include "platform/log.hpp"
#include "platform/numbers.hpp"
#include "platform/process.hpp"

namespace {

constexpr std::int64_t kMountPeriod_us = 1'000'000;

/// The mount check with its channel, its file and its word in the process's health.
class MountWatch {
 public:
  MountWatch(plumb::Process& process, const plumb::MountConfig& config)
      : process_(process),
        state_file_(config.state_file),
        check_(config),
        mount_(process.bus(), plumb::kMount) {
    if (state_file_.empty() || !std::filesystem::exists(state_file_)) return;
    try {
      check_.restore(plumb::load_mount_reference(state_file_));
    } catch (const plumb::ConfigError& error) {
      // The vehicle drives on without it.
      plumb::log_line("%s; a new reference is made", error.what());
    }
  }

  void update(const plumb::GroundOutput& ground) {
    const bool had_reference = check_.report().reference.has_value();
    const plumb::MountStatus before = check_.report().status;
    const plumb::MountReport& report = check_.update(ground);
    if (!had_reference && report.reference) save(*report.reference);
    if (report.status != before) tell(report);
    if (ground.capture_us - published_us_ < kMountPeriod_us && report.status == before) return;
    published_us_ = ground.capture_us;
    plumb::to_wire(report, ground.capture_us, &message_);
    mount_.publish(message_);
  }

 private:
  void save(const plumb::MountReference& reference) const {
    if (state_file_.empty()) return;
    try {
      plumb::save_mount_reference(state_file_, reference);
    } catch (const plumb::InputError& error) {
      plumb::log_line("%s", error.what());
    }
  }

  void tell(const plumb::MountReport& report) {
    if (report.status != plumb::MountStatus::kMoved) return process_.health().clear_condition();
    const Eigen::Vector3d off_rad = report.recent_rad - report.reference->mean_rad;
    char text[128];
    std::snprintf(text, sizeof text,
                  "the camera has moved on its mount: pitch %+.1f, roll %+.1f, yaw %+.1f deg",
                  plumb::degrees(off_rad.x()), plumb::degrees(off_rad.y()),
                  plumb::degrees(off_rad.z()));
    process_.health().set_condition(plumb::HealthState::kDegraded, text);
    plumb::log_line("%s", text);
  }

  plumb::Process& process_;
  std::string state_file_;
  plumb::MountCheck check_;
  plumb::Publisher<plumb::mount_t> mount_;
  plumb::mount_t message_{};
  std::int64_t published_us_ = 0;
};

class GroundProcess {
 public:
  GroundProcess(plumb::Process& process, const plumb::PlumbConfig& config)
      : process_(process),
        node_(
            config.ground, &process.timer(),
            [this](const auto& plane, const auto& ego) { publish(plane, ego); },
            plumb::load_ground_model(config.ground.model_file)),
        plane_(process.bus(), plumb::kGroundPlane),
        ego_(process.bus(), plumb::kEgoMotion),
        mount_(process, config.mount),
        calibration_(process.bus(), plumb::kCameraCalibration, plumb::Input::kOccasional,
                     [this](const plumb::camera_calibration_t& m) { return on_calibration(m); }),
        camera_(process.bus(), plumb::kCamera, plumb::Input::kPeriodic,
                [this](plumb::RawSubscriber::Bytes bytes) { return on_image(bytes); }),
        motion_(process.bus(), plumb::kVoMotion, plumb::Input::kPeriodic,
                [this](const plumb::vo_motion_t& m) { return on_motion(m); }),
        image_timeout_(process.loop().timer([this] { node_.expire(); })) {
    process.health().set_condition(plumb::HealthState::kWaiting, "no CAMERA_CALIBRATION yet");
  }

 private:
  const char* on_calibration(const plumb::camera_calibration_t& message) {
    const bool waited = !node_.calibrated();
    const char* refused = node_.take_calibration(message);
    if (waited && node_.calibrated()) process_.health().clear_condition();
    return refused;
  }

  const char* on_image(plumb::RawSubscriber::Bytes bytes) {
    const char* refused = node_.take_image(bytes);
    process_.counters().num_dropped = node_.num_lost();
    return refused;
  }

  const char* on_motion(const plumb::vo_motion_t& message) {
    const char* refused = node_.take_motion(message);
    if (node_.waiting()) {
      process_.loop().arm_at(image_timeout_, plumb::monotonic_us() + plumb::kCamera.stale_us);
    }
    process_.counters().num_dropped = node_.num_lost();
    return refused;
  }

  void publish(const plumb::ground_plane_t& plane, const plumb::ego_motion_t& ego) {
    plane_.publish(plane);
    ego_.publish(ego);
    if (node_.output() != nullptr) mount_.update(*node_.output());
    process_.timer().end();
  }

  plumb::Process& process_;
  plumb::GroundNode node_;
  plumb::Publisher<plumb::ground_plane_t> plane_;
  plumb::Publisher<plumb::ego_motion_t> ego_;
  MountWatch mount_;
  plumb::Subscriber<plumb::camera_calibration_t> calibration_;
  plumb::RawSubscriber camera_;
  plumb::Subscriber<plumb::vo_motion_t> motion_;
  plumb::EventLoop::TimerId image_timeout_;
};

}  // namespace

int main(int argc, char** argv) {
  plumb::Process process({"ground",
                          "Ground plane, scale and metric motion: CAMERA, VO_MOTION -> "
                          "GROUND_PLANE, EGO_MOTION, MOUNT",
                          plumb::kHealthGround});
  plumb::PlumbConfig config;
  std::optional<GroundProcess> ground;
  return process.run(argc, argv, &config, [&] { ground.emplace(process, config); });
}
