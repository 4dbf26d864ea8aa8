/// The CAN database (DBC) of one configuration, made from the tables of signals.
///
/// Objects:
///   Their messages are multiplexed by the index in the list: the same bits are called Obj0_PosX
///   for index 0 and Obj7_PosX for index 7.
/// Identifiers:
///   Those of 29 bits carry bit 31, as a DBC demands.
#pragma once

#include <string>

#include "modules/can/can_signal.hpp"

namespace plumb {

/// Returns the whole text. @pre `messages` are those of this `config`
[[nodiscard]] std::string render_dbc(const CanConfig& config, const Messages& messages);

}  // namespace plumb
