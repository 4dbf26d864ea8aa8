/// GroundOutput <-> ground_plane_t and ego_motion_t. No LCM instance.
#pragma once

#include "modules/ground/types/ground_types.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"

namespace plumb {

void to_wire(const GroundOutput& output, ground_plane_t* message);
void to_wire(const GroundOutput& output, ego_motion_t* message);

/// Null, and `output` filled, when both messages keep their contracts and are of the same image; else why not.
[[nodiscard]] const char* from_wire(const ground_plane_t& plane, const ego_motion_t& ego,
                                    GroundOutput* output);

}  // namespace plumb
