/// Converts the messages of the mount, without an LCM instance.
#pragma once

#include <cstdint>

#include "modules/mount/height_learner.hpp"
#include "modules/mount/mount_check.hpp"
#include "modules/mount/speed_track.hpp"
#include "plumb/mount_t.hpp"
#include "plumb/vehicle_speed_t.hpp"

namespace plumb {

/// Writes everything but the height.
void to_wire(const MountReport& report, std::int64_t capture_us, mount_t* message);
/// Writes the height.
void to_wire(const HeightReport& report, mount_t* message);

/// Returns null, or why the message is refused.
[[nodiscard]] const char* from_wire(const vehicle_speed_t& message, VehicleSpeed* speed);

}  // namespace plumb
