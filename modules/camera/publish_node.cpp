#include "modules/camera/publish_node.hpp"

namespace plumb {

PublishNode::PublishNode(Process& process, const CameraConfig& config,
                         const std::filesystem::path& folder)
    : process_(process),
      node_(config, folder, &process.timer(), process.session()),
      image_(process.bus(), kCamera, node_.max_bytes()),
      calibration_(process.bus(), kCameraCalibration) {}

void PublishNode::publish(const GreyFrame& frame) {
  constexpr std::int64_t kCalibrationPeriod_us = 1'000'000;
  const std::int64_t since_us = frame.capture_us - calibrated_us_;
  if (!calibrated_ || since_us < 0 || since_us >= kCalibrationPeriod_us) {
    calibrated_ = true;
    calibrated_us_ = frame.capture_us;
    calibration_.publish(node_.calibration(frame.capture_us));
  }
  image_.publish(node_.take(frame));
  process_.timer().mark("publish");
}

void PublishNode::show_fault() {
  if (node_.fault() == ImageFault::kNone) {
    process_.health().clear_condition();
  } else {
    process_.health().set_condition(HealthState::kDegraded, describe(node_.fault()));
  }
}

}  // namespace plumb
