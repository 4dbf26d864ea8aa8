/// GROUND_PLANE, EGO_MOTION, MOUNT and OBJECTS -> the values of their signals.
#pragma once

#include "modules/can/can_object_gate.hpp"
#include "modules/can/can_sample.hpp"
#include "modules/can/judge_wire.hpp"
#include "plumb/mount_t.hpp"
#include "plumb/objects_t.hpp"

namespace plumb {

/// Returns what is wrong when the message breaks its contract, else null: an unknown status, a
/// negative seq, an infinite number, a negative standard deviation. NaN is no fault of a motion: it
/// was not measured.
[[nodiscard]] const char* fault_of(const ego_motion_t& message);
[[nodiscard]] const char* fault_of(const ground_plane_t& message);
[[nodiscard]] const char* fault_of(const mount_t& message);
/// One broken object breaks the message.
[[nodiscard]] const char* fault_of(const objects_t& message);

/// They fill the output with the values of all signals that come from the message. @pre its
/// fault_of() is null; `messages` come from can_messages()
void to_sample(const JudgedMotion& motion, const Messages& messages, CanSample* sample);
void to_sample(const JudgedPlane& plane, const Messages& messages, CanSample* sample);
void to_sample(const mount_t& mount, const Messages& messages, CanSample* sample);
/// Takes the nearest kMaxCanObjects that have a place on the road, the nearest first.
void to_sample(const objects_t& message, const Messages& messages, CanObjects* objects);

}  // namespace plumb
