/// CAMERA, CAMERA_CALIBRATION -> visual odometry -> VO_MOTION
#include <algorithm>
#include <optional>

#include "modules/camera/front_end.hpp"
#include "modules/chain/plumb_config.hpp"
#include "modules/vo/vo_node.hpp"
#include "platform/clock.hpp"
#include "platform/command_line.hpp"
#include "platform/process.hpp"

namespace {

class VoProcess {
 public:
  VoProcess(plumb::Process& process, const plumb::PlumbConfig& config, std::uint64_t seed)
      : process_(process),
        max_wait_us_(config.images.max_wait_us()),
        node_(config.vo, seed, &process.timer(), config.integrity),
        motion_(process.bus(), plumb::kVoMotion),
        calibration_(process.bus(), plumb::kCameraCalibration, plumb::Input::kOccasional,
                     [this](const plumb::camera_calibration_t& m) { return on_calibration(m); }),
        camera_(
            process.bus(), plumb::kCamera, plumb::Input::kPeriodic,
            [this](plumb::RawSubscriber::Bytes bytes) { return on_image(bytes); },
            plumb::image_memory(config.images.max_pixels)) {
    node_.set_session(process.session());
    if (const auto camera = plumb::stated_model(config.camera)) {
      node_.configure_camera(*camera);
    } else {
      process.health().set_condition(plumb::HealthState::kWaiting, "no CAMERA_CALIBRATION yet");
    }
  }

 private:
  const char* on_calibration(const plumb::camera_calibration_t& message) {
    const char* refused = node_.take_calibration(message);
    if (ready_us_ == 0 && node_.calibrated()) ready_us_ = plumb::monotonic_us();
    refused_calibration_ = refused;
    show_condition();
    return refused;
  }

  void show_condition() {
    if (!node_.calibrated()) return;
    const char* concern = refused_calibration_ != nullptr ? refused_calibration_ : node_.concern();
    if (concern != nullptr) {
      process_.health().set_condition(plumb::HealthState::kDegraded, concern);
    } else {
      process_.health().clear_condition();
    }
  }

  const char* on_image(plumb::RawSubscriber::Bytes bytes) {
    if (camera_.is_overtaken(max_wait_us_, ready_us_)) {
      camera_.skip();
      return nullptr;
    }
    const char* refused = node_.take_image(bytes, camera_.arrival_us());
    if (node_.motion() != nullptr) {
      camera_.set_capture_us(node_.motion()->capture_mono_us);
      motion_.publish(*node_.motion());
      show_condition();
    }
    // A skipped image leaves a gap in the numbers, too.
    process_.counters().num_dropped =
        std::max<std::int64_t>(0, node_.num_lost() - camera_.num_skipped());
    if (refused == nullptr) process_.timer().end();
    return refused;
  }

  plumb::Process& process_;
  std::int64_t max_wait_us_;
  const char* refused_calibration_ = nullptr;  ///< why the newest calibration was refused, or null
  std::int64_t ready_us_ = 0;  ///< monotonic time at which the estimator had been created
  plumb::VoNode node_;
  plumb::Publisher<plumb::vo_motion_t> motion_;
  plumb::Subscriber<plumb::camera_calibration_t> calibration_;
  plumb::RawSubscriber camera_;
};

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): add_option throws for a name given twice, and for nothing else
int main(int argc, char** argv) {
  plumb::Process process(
      {"vo", "Monocular visual odometry: CAMERA -> VO_MOTION", plumb::kHealthVo});
  plumb::PlumbConfig config;
  std::uint64_t seed = 1;
  process.declare_options([&seed](plumb::CommandLine& app) {
    app.add_option("--seed", seed, "seed of the random sampling; default 1");
  });
  std::optional<VoProcess> vo;
  return process.run(argc, argv, &config, [&] { vo.emplace(process, config, seed); });
}
