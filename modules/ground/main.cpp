/// CAMERA, CAMERA_CALIBRATION, VO_MOTION -> ground plane, scale, metric motion -> GROUND_PLANE, EGO_MOTION
#include <optional>

#include "modules/config.hpp"
#include "modules/ground/ground_model_source.hpp"
#include "modules/ground/ground_node.hpp"
#include "platform/clock.hpp"
#include "platform/process.hpp"

namespace {

class GroundProcess {
 public:
  GroundProcess(plumb::Process& process, const plumb::GroundConfig& config)
      : process_(process),
        node_(
            config, &process.timer(),
            [this](const auto& plane, const auto& ego) { publish(plane, ego); },
            plumb::load_ground_model(config.model_file)),
        plane_(process.bus(), plumb::kGroundPlane),
        ego_(process.bus(), plumb::kEgoMotion),
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
    const char* refused = node_.take_calibration(message);
    if (node_.calibrated()) process_.health().clear_condition();
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
    process_.timer().end();
  }

  plumb::Process& process_;
  plumb::GroundNode node_;
  plumb::Publisher<plumb::ground_plane_t> plane_;
  plumb::Publisher<plumb::ego_motion_t> ego_;
  plumb::Subscriber<plumb::camera_calibration_t> calibration_;
  plumb::RawSubscriber camera_;
  plumb::Subscriber<plumb::vo_motion_t> motion_;
  plumb::EventLoop::TimerId image_timeout_;
};

}  // namespace

int main(int argc, char** argv) {
  plumb::Process process({"ground",
                          "Ground plane, scale and metric motion: CAMERA, VO_MOTION -> "
                          "GROUND_PLANE, EGO_MOTION",
                          plumb::kHealthGround});
  plumb::PlumbConfig config;
  std::optional<GroundProcess> ground;
  return process.run(argc, argv, &config, [&] { ground.emplace(process, config.ground); });
}
