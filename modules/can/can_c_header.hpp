/// A C99 header for receivers of one configuration, made from the tables of signals. Its names are
/// those that cantools would give: plumbline_plb_ego_motion_unpack() and so on.
#pragma once

#include <string>

#include "modules/can/can_signal.hpp"

namespace plumb {

/// Returns the whole text. @pre `messages` are those of this `config`
[[nodiscard]] std::string render_c_header(const CanConfig& config, const Messages& messages);

}  // namespace plumb
