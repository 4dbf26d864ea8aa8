/// GroundOutput <-> ground_plane_t and ego_motion_t. Uses no LCM instance.
///
/// Memory:
///   The list of cues in a message is sized once; a message that is used again does not allocate.
#pragma once

#include "modules/ground/types/ground_types.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"

namespace plumb {

void to_wire(const GroundOutput& output, ground_plane_t* message);
void to_wire(const GroundOutput& output, ego_motion_t* message);
/// Makes the plane of the message one that is not known yet. Its cues stay.
void withhold_plane(ground_plane_t* message);

/// Fills `output` and returns null when both messages keep their contracts and belong to the same
/// image; else returns why not. Cues beyond kNumCues are ignored, missing ones are absent.
[[nodiscard]] const char* from_wire(const ground_plane_t& plane, const ego_motion_t& ego,
                                    GroundOutput* output);

}  // namespace plumb
