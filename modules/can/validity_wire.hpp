/// What the values of a message are worth on the bus, by its status.
#pragma once

#include <cmath>

#include "modules/can/can_state.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/mount_t.hpp"
#include "plumb/vo_motion_t.hpp"

namespace plumb {

[[nodiscard]] inline CanValidity validity_of(const ego_motion_t& message) {
  switch (message.status) {
    case ego_motion_t::STATUS_OK:
      return CanValidity::kValid;
    case ego_motion_t::STATUS_STANDSTILL:
      // Equal images are what a standing camera sends, and what a broken one does.
      return message.reason == vo_motion_t::REASON_IMAGE_UNPROVEN ? CanValidity::kDegraded
                                                                  : CanValidity::kValid;
    case ego_motion_t::STATUS_SCALE_HELD:
    case ego_motion_t::STATUS_COASTING:
      return CanValidity::kDegraded;
    default:
      return CanValidity::kInvalid;
  }
}

[[nodiscard]] inline CanValidity validity_of(const ground_plane_t& message) {
  if (message.status == ground_plane_t::STATUS_OK) return CanValidity::kValid;
  if (message.status == ground_plane_t::STATUS_HELD) return CanValidity::kDegraded;
  return CanValidity::kInvalid;
}

/// Angles off the reference need a reference.
[[nodiscard]] inline CanValidity validity_of(const mount_t& message) {
  const bool has_reference =
      message.status == mount_t::STATUS_STEADY || message.status == mount_t::STATUS_MOVED;
  return has_reference ? CanValidity::kValid : CanValidity::kInvalid;
}

/// Whether a number can be a standard deviation or a variance.
[[nodiscard]] inline bool is_std(double value) { return std::isfinite(value) && value >= 0.0; }

}  // namespace plumb
