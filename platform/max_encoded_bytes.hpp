/// [bytes] The largest encoding of a message: what a reader must have room for.
///
/// A message of fixed size takes no more than the structure that holds it, and 8 bytes for its
/// fingerprint. A new message of variable size does not compile until it has its own limit.
#pragma once

#include <cstddef>
#include <type_traits>

#include "plumb/detections_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/objects_t.hpp"
#include "plumb/process_health_t.hpp"

namespace plumb {

template <typename Message>
requires std::is_trivially_copyable_v<Message>
[[nodiscard]] constexpr std::size_t max_encoded_bytes(const Message* /*type*/) {
  return sizeof(Message) + 8;
}
[[nodiscard]] constexpr std::size_t max_encoded_bytes(const detections_t* /*type*/) {
  return sizeof(detections_t) + detections_t::MAX_DETECTIONS * sizeof(detection_t) + 8;
}
[[nodiscard]] constexpr std::size_t max_encoded_bytes(const ground_plane_t* /*type*/) {
  return sizeof(ground_plane_t) + ground_plane_t::MAX_CUES * sizeof(ground_cue_t) + 8;
}
[[nodiscard]] constexpr std::size_t max_encoded_bytes(const objects_t* /*type*/) {
  return sizeof(objects_t) + objects_t::MAX_OBJECTS * sizeof(object_t) + 8;
}
/// Health cuts its texts so that they fit.
[[nodiscard]] constexpr std::size_t max_encoded_bytes(const process_health_t* /*type*/) {
  return 4096;
}

}  // namespace plumb
