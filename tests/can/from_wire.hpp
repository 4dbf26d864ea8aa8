/// Messages -> samples as CanOutput makes them, without the judgement of the vehicle's limits.
#pragma once

#include "modules/can/sample_wire.hpp"

namespace plumb::test {

inline const char* from_wire(const ego_motion_t& message, const Messages& messages,
                             CanSample* sample) {
  if (const char* const fault = fault_of(message)) return fault;
  JudgedMotion judged;
  take_at_its_word(message, &judged);
  to_sample(judged, messages, sample);
  return nullptr;
}

inline const char* from_wire(const ground_plane_t& message, const Messages& messages,
                             CanSample* sample) {
  if (const char* const fault = fault_of(message)) return fault;
  JudgedPlane judged;
  take_at_its_word(message, &judged);
  to_sample(judged, messages, sample);
  return nullptr;
}

/// MOUNT -> CanSample, OBJECTS -> CanObjects
template <typename Message, typename Sample>
const char* from_wire(const Message& message, const Messages& messages, Sample* sample) {
  if (const char* const fault = fault_of(message)) return fault;
  to_sample(message, messages, sample);
  return nullptr;
}

}  // namespace plumb::test
