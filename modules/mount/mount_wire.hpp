/// Converts MountReport to mount_t, without an LCM instance.
#pragma once

#include <cstdint>

#include "modules/mount/mount_check.hpp"
#include "plumb/mount_t.hpp"

namespace plumb {

void to_wire(const MountReport& report, std::int64_t capture_us, mount_t* message);

}  // namespace plumb
