/// The CAN database (DBC) of one configuration, made from the tables of signals.
///
/// Objects   their messages are multiplexed by the index in the list: object 0's position is
///           Obj0_PosX, object 7's is Obj7_PosX, in the same bits.
/// Extended  identifiers of 29 bits carry bit 31, as a DBC asks.
#pragma once

#include <string>

#include "modules/can/can_signal.hpp"

namespace plumb {

/// The whole text. `messages` as can_messages() returned them for this `config`.
[[nodiscard]] std::string render_dbc(const CanConfig& config, const Messages& messages);

}  // namespace plumb
