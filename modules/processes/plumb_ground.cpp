/// plumb-ground: CAMERA, CAMERA_CALIBRATION, VO_MOTION, DETECTIONS, VEHICLE_SPEED
///   -> GROUND_PLANE, EGO_MOTION, MOUNT
#include <optional>

#include "modules/camera/front_end.hpp"
#include "modules/chain/model_file_source.hpp"
#include "modules/chain/plumb_config.hpp"
#include "modules/ground/ground_node.hpp"
#include "modules/mount/mount_node.hpp"
#include "platform/clock.hpp"
#include "platform/process.hpp"

namespace {

class GroundProcess {
 public:
  GroundProcess(plumb::Process& process, const plumb::PlumbConfig& config)
      : process_(process),
        max_wait_us_(config.images.max_wait_us()),
        models_(plumb::load_models(config.ground.model_file)),
        node_(
            config.ground, config.detections, &process.timer(),
            [this](const auto& plane, const auto& ego) { publish(plane, ego); }, models_.ground),
        plane_(process.bus(), plumb::kGroundPlane),
        ego_(process.bus(), plumb::kEgoMotion),
        mount_(process.bus(), plumb::kMount),
        mount_node_(config.mount),
        calibration_(process.bus(), plumb::kCameraCalibration, plumb::Input::kOccasional,
                     [this](const plumb::camera_calibration_t& m) { return on_calibration(m); }),
        camera_(
            process.bus(), plumb::kCamera, plumb::Input::kPeriodic,
            [this](plumb::RawSubscriber::Bytes bytes) { return on_image(bytes); },
            plumb::image_memory(config.images.max_pixels)),
        motion_(process.bus(), plumb::kVoMotion, plumb::Input::kPeriodic,
                [this](const plumb::vo_motion_t& m) { return on_motion(m); }),
        detections_(process.bus(), plumb::kDetections, plumb::Input::kOccasional,
                    [this](const plumb::detections_t& m) { return on_detections(m); }),
        vehicle_speed_(
            process.bus(), plumb::kVehicleSpeed, plumb::Input::kOccasional,
            [this](const plumb::vehicle_speed_t& m) { return mount_node_.take_speed(m); }),
        image_timeout_(process.loop().timer([this] { on_timeout(); })) {
    node_.set_session(process.session());
    if (const auto camera = plumb::stated_model(config.camera)) {
      node_.configure_camera(*camera);
    } else {
      process.health().set_condition(plumb::HealthState::kWaiting, "no CAMERA_CALIBRATION yet");
    }
  }

 private:
  const char* on_calibration(const plumb::camera_calibration_t& message) {
    const bool waited = !node_.calibrated();
    const char* refused = node_.take_calibration(message);
    if (waited && node_.calibrated()) {
      ready_us_ = plumb::monotonic_us();
      process_.health().clear_condition();
    }
    return refused;
  }

  /// Images may be left out when this process is behind. Motions may not: the path is their sum.
  const char* on_image(plumb::RawSubscriber::Bytes bytes) {
    const bool is_overtaken = camera_.is_overtaken(max_wait_us_, ready_us_);
    if (is_overtaken) camera_.skip();
    const char* refused = is_overtaken ? node_.skip_image(bytes) : node_.take_image(bytes);
    count();
    return refused;
  }

  const char* on_motion(const plumb::vo_motion_t& message) {
    const char* refused = node_.take_motion(message);
    if (node_.waiting()) {
      process_.loop().arm_at(image_timeout_, plumb::monotonic_us() + plumb::kCamera.stale_us);
    }
    count();
    return refused;
  }

  const char* on_detections(const plumb::detections_t& message) {
    const char* refused = node_.take_detections(message);
    count();
    return refused;
  }

  void count() {
    plumb::Counters& counters = process_.counters();
    counters.num_dropped = node_.num_lost() + node_.num_overflowed();
    counters.num_unpaired = node_.num_unpaired();
  }

  void on_timeout() {
    node_.expire();
    count();
  }

  void publish(const plumb::ground_plane_t& plane, const plumb::ego_motion_t& ego) {
    plane_.publish(plane);
    ego_.publish(ego);
    if (node_.output() != nullptr) watch_mount(*node_.output());
    process_.timer().end();
  }

  void watch_mount(const plumb::GroundOutput& output) {
    const bool alarmed = mount_node_.alarm() != nullptr;
    const plumb::mount_t* message =
        mount_node_.update(output, node_.stated_height(), node_.num_cameras());
    if (const plumb::CameraHeight* height = mount_node_.better_height())
      node_.correct_camera_height(*height);
    if (message == nullptr) return;
    mount_.publish(*message);
    const char* alarm = mount_node_.alarm();
    if (alarm != nullptr) {
      process_.health().set_condition(plumb::HealthState::kDegraded, alarm);
    } else if (alarmed) {
      process_.health().clear_condition();
    }
  }

  plumb::Process& process_;
  std::int64_t max_wait_us_;
  std::int64_t ready_us_ = 0;  ///< monotonic time at which the estimator had been created
  plumb::TrainedModels models_;
  plumb::GroundNode node_;
  plumb::Publisher<plumb::ground_plane_t> plane_;
  plumb::Publisher<plumb::ego_motion_t> ego_;
  plumb::Publisher<plumb::mount_t> mount_;
  plumb::MountNode mount_node_;
  plumb::Subscriber<plumb::camera_calibration_t> calibration_;
  plumb::RawSubscriber camera_;
  plumb::Subscriber<plumb::vo_motion_t> motion_;
  plumb::Subscriber<plumb::detections_t> detections_;
  plumb::Subscriber<plumb::vehicle_speed_t> vehicle_speed_;
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
  return process.run(argc, argv, &config, [&] {
    if (config.ground_mode != "default")  // OpenCV's SIFT stays out of the vehicle
      throw plumb::UsageError("ground.mode = \"" + config.ground_mode +
                              "\" is for comparison: plumb-replay runs it, plumb-ground does not");
    ground.emplace(process, config);
  });
}
