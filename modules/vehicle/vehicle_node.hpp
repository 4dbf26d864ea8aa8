/// Everything plumb-vehicle does between a CAN frame and VEHICLE_SPEED.
///
/// Time:
///   A frame arrives on this machine's monotonic clock, and VEHICLE_SPEED is stamped on the
///   camera's. EGO_MOTION states both times of an image; before the first one that does, nothing is
///   sent. Times increase: a frame that would be stamped at or shortly before the last one, because
///   images have corrected the clock or frames were read at once, is left out.
#pragma once

#include <cstdint>
#include <optional>

#include "modules/vehicle/dbc_signal.hpp"
#include "modules/vehicle/vehicle_speed_config.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/vehicle_speed_t.hpp"

namespace plumb {

class VehicleNode {
 public:
  /// @param signal  forward speed in m/s
  VehicleNode(const VehicleSpeedConfig& config, const DbcSignal& signal, std::int64_t session);

  /// Takes the clocks of an image. Returns null: a message that states none is not refused.
  const char* take_ego(const ego_motion_t& message);
  /// Returns the message to publish, or null: another frame, a speed that the vehicle does not
  /// know, no clock yet, or a time that is not later than the last one. The message is valid until
  /// the next call.
  const vehicle_speed_t* take_frame(const CanFrame& frame, std::int64_t received_mono_us);

  [[nodiscard]] bool has_clock() const { return mono_minus_camera_us_.has_value(); }
  /// Number of frames of the signal's message that carried no speed.
  [[nodiscard]] std::int64_t num_unknown() const { return num_unknown_; }

 private:
  DbcSignal signal_;
  std::int64_t delay_us_;
  std::optional<std::int64_t> mono_minus_camera_us_;
  std::optional<std::int64_t> last_utime_;
  std::int64_t num_unknown_ = 0;
  vehicle_speed_t message_{};
};

}  // namespace plumb
