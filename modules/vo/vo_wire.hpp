/// VoOutput <-> vo_motion_t. No LCM instance.
#pragma once

#include "modules/vo/vo.hpp"
#include "plumb/vo_motion_t.hpp"

namespace plumb {

void to_wire(const VoOutput& output, vo_motion_t* message);

/// Null, and `output` filled, when the message keeps its contract (counts and enumerations in range, numbers finite
/// where they must be, unit quaternions, window newest first); else why not, as a literal.
[[nodiscard]] const char* from_wire(const vo_motion_t& message, VoOutput* output);

}  // namespace plumb
