#include "modules/vehicle/vehicle_node.hpp"

#include <cmath>

#include "modules/integrity/stamp_difference.hpp"

namespace plumb {
namespace {

// Each image states the camera's clock anew. A step back by less than that is a correction, and
// one by more another time base.
constexpr std::int64_t kLargestCorrection_us = 1'000'000;

}  // namespace

VehicleNode::VehicleNode(const VehicleSpeedConfig& config, const DbcSignal& signal,
                         std::int64_t session)
    : signal_(signal), delay_us_(std::llround(1e6 * config.delay_s)) {
  message_.session = session;
  message_.scale_std = config.scale_std;
}

const char* VehicleNode::take_ego(const ego_motion_t& message) {
  if (message.capture_mono_us > 0) mono_minus_camera_us_ = message.capture_mono_us - message.utime;
  return nullptr;
}

const vehicle_speed_t* VehicleNode::take_frame(const CanFrame& frame,
                                               std::int64_t received_mono_us) {
  if (frame.id != signal_.id || frame.extended != signal_.extended) return nullptr;
  const std::optional<double> speed_m_s = signal_.value(frame);
  if (!speed_m_s) {
    ++num_unknown_;
    return nullptr;
  }
  if (!has_clock()) return nullptr;
  const std::int64_t utime = received_mono_us - delay_us_ - *mono_minus_camera_us_;
  const std::int64_t back_us = last_utime_ ? stamp_difference(*last_utime_, utime) : -1;
  if (back_us >= 0 && back_us < kLargestCorrection_us) return nullptr;
  last_utime_ = utime;
  message_.utime = utime;
  message_.speed_m_s = *speed_m_s;
  return &message_;
}

}  // namespace plumb
