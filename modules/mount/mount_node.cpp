#include "modules/mount/mount_node.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/input_error.hpp"
#include "core/numbers.hpp"
#include "modules/mount/mount_source.hpp"
#include "platform/config.hpp"
#include "platform/log.hpp"

namespace plumb {

MountNode::MountNode(const MountConfig& config)
    : state_file_(config.state_file), check_(config), height_(config) {
  std::error_code unknown;
  if (state_file_.empty() || (!std::filesystem::exists(state_file_, unknown) && !unknown)) return;
  try {
    check_.restore(load_mount_reference(state_file_));
  } catch (const ConfigError& error) {
    log_warning("%s; a new reference will be made", error.what());
  }
}

const char* MountNode::take_speed(const vehicle_speed_t& message) {
  VehicleSpeed speed;
  if (const char* why = from_wire(message, &speed)) return why;
  if (speed_sender_.take(message.session) == OneSender::Verdict::kForeign)
    return "vehicle speed comes from a second sender";
  return height_.take_speed(speed);
}

const CameraHeight* MountNode::better_height() const {
  const HeightReport& height = height_.report();
  return std::isnan(height.by_vehicle.height_m) ? nullptr : &height.used;
}

const mount_t* MountNode::update(const GroundOutput& ground, const CameraHeight& stated_height,
                                 int camera) {
  if (camera != camera_) height_.forget();
  camera_ = camera;
  const bool had_reference = check_.report().reference.has_value();
  const MountStatus before = check_.report().status;
  const HeightStatus height_before = height_.report().status;
  const MountReport& report = check_.update(ground);
  const HeightReport& height = height_.update(ground, stated_height);
  if (!had_reference && report.reference) save();
  const bool stepped_back = ground.capture_us < published_us_;
  const bool due = stepped_back || ground.capture_us - published_us_ >= kPeriod_us;
  const bool changed = report.status != before || height.status != height_before;
  if (!due && !changed) return nullptr;
  published_us_ = ground.capture_us;
  write_alarm(stated_height);
  if (changed && alarm() != nullptr) log_warning("%s", alarm_);
  to_wire(report, ground.capture_us, &message_);
  to_wire(height, &message_);
  return &message_;
}

const char* MountNode::alarm() const { return alarm_[0] != '\0' ? alarm_ : nullptr; }

void MountNode::save() const {
  if (state_file_.empty()) return;
  try {
    save_mount_reference(state_file_, *check_.report().reference);
  } catch (const InputError& error) {
    log_warning("%s", error.what());
  }
}

void MountNode::write_alarm(const CameraHeight& stated_height) {
  alarm_[0] = '\0';
  const MountReport& report = check_.report();
  const HeightReport& height = height_.report();
  if (height.status == HeightStatus::kContradicted) {
    std::snprintf(alarm_, sizeof alarm_,
                  "the camera is stated to be %.3f m above the road, the vehicle's speed says %.3f "
                  "+- %.3f m",
                  stated_height.height_m, height.by_vehicle.height_m, height.by_vehicle.std_m);
  }
  if (report.status == MountStatus::kMisaligned) {
    std::snprintf(
        alarm_, sizeof alarm_,
        "the camera looks far off the direction of travel: %+.1f deg down, %+.1f deg left",
        degrees(report.recent_rad.x()), degrees(report.recent_rad.z()));
  }
  if (report.status != MountStatus::kMoved) return;
  const Eigen::Vector3d off_rad = report.recent_rad - report.reference->mean_rad;
  std::snprintf(alarm_, sizeof alarm_,
                "the camera has moved on its mount: pitch %+.1f, roll %+.1f, yaw %+.1f deg",
                degrees(off_rad.x()), degrees(off_rad.y()), degrees(off_rad.z()));
}

}  // namespace plumb
