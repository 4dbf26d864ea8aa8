/// VoOutput <-> vo_motion_t, without an instance of LCM.
#pragma once

#include "modules/vo/vo.hpp"
#include "plumb/vo_motion_t.hpp"

namespace plumb {

/// Writes all fields. Rows beyond the counts are zero.
void to_wire(const VoOutput& output, vo_motion_t* message);

/// Reads a message. Returns null when it is valid: counts and enumerations are in range, numbers
/// are finite, quaternions are of unit length, and the window has the newest frame first. Else
/// returns the reason as a string literal, and `output` is unspecified.
[[nodiscard]] const char* from_wire(const vo_motion_t& message, VoOutput* output);

}  // namespace plumb
