/// Identifier, data identifier and cycle of every message in one configuration.
#pragma once

#include <array>
#include <cstdint>

#include "modules/can/can_config.hpp"

namespace plumb {

struct CanAddress {
  std::uint32_t id = 0;
  bool extended = false;
  std::uint16_t data_id = 0;  ///< AUTOSAR E2E
  int cycle_ms = 0;           ///< 0: sent only with what it belongs to
};

/// Throws InputError for identifiers that do not fit or are used twice, for cycles that are not a
/// multiple of the tick, and for a node's name that a DBC cannot hold.
[[nodiscard]] std::array<CanAddress, kNumMessages> can_addresses(const CanConfig& config);

}  // namespace plumb
