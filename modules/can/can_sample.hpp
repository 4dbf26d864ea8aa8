/// What one input message gives to the bus: a value for each of its signals, or "not available".
///
/// Rule:
///   A receiver must be able to trust what it gets, so settle_values() takes away what cannot be
///   sent as it is: a value beyond the range of its signal; a value whose standard deviation cannot
///   be sent, and a deviation without its value; all values of a group that is not valid.
/// Memory:
///   Fixed arrays.
#pragma once

#include <array>
#include <cstdint>

#include "modules/can/can_signal.hpp"

namespace plumb {

/// What one GROUND_PLANE, EGO_MOTION or MOUNT gives to the bus.
struct CanSample {
  std::int64_t seq = 0;              ///< of the camera frame; a mount has none
  std::int64_t session = 0;          ///< of the sender
  std::int64_t capture_mono_us = 0;  ///< on the gates' clock; 0: not known. A mount has none
  CanValidity validity = CanValidity::kInvalid;  ///< the lowest of its groups
  bool has_values = false;                       ///< some group is not invalid
  bool is_initializing = false;
  SourceValues values{};
};

/// The validity of each group of a source's values.
using GroupValidities = std::array<CanValidity, kNumGroups>;

/// Fills all groups alike.
[[nodiscard]] constexpr GroupValidities same_validity(CanValidity validity) {
  GroupValidities all{};
  all.fill(validity);
  return all;
}
constexpr void lower_validity(CanValidity limit, CanValidity* validity) {
  if (*validity > limit) *validity = limit;
}

/// Takes away what must not be sent of the values that this source was read into, lowers the
/// validities of groups that lack a value they need, and enters the validities.
void settle_values(CanSource source, const Messages& messages, GroupValidities* validities,
                   SourceValues* values);

}  // namespace plumb
