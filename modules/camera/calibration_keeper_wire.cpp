#include "modules/camera/calibration_keeper_wire.hpp"

#include <utility>

#include "modules/camera/image_wire.hpp"

namespace plumb {

void CalibrationKeeper::configure(const CameraModel& camera) {
  adopt(camera);
  is_configured_ = true;
}

const char* CalibrationKeeper::take(const camera_calibration_t& message) {
  CameraModel camera;
  if (const char* why = from_wire(message, &camera)) return why;
  if (!is_known_) adopt(camera);
  if (same_camera(camera, camera_)) {
    num_against_ = 0;
    return nullptr;
  }
  num_against_ = num_against_ > 0 && same_camera(camera, other_) ? num_against_ + 1 : 1;
  other_ = camera;
  if (is_configured_) return "calibration contradicts the one that the configuration states";
  if (num_against_ < kNumToAdopt) return "calibration contradicts the earlier ones";
  adopt(camera);
  return nullptr;
}

bool CalibrationKeeper::take_change() { return std::exchange(has_changed_, false); }

void CalibrationKeeper::adopt(const CameraModel& camera) {
  camera_ = camera;
  is_known_ = true;
  has_changed_ = true;
  num_against_ = 0;
}

}  // namespace plumb
