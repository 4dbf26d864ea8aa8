/// Reads the speed signal of a vehicle from its CAN database.
#pragma once

#include <string>
#include <string_view>

#include "modules/vehicle/dbc_signal.hpp"
#include "modules/vehicle/vehicle_speed_config.hpp"

namespace plumb {

/// Finds the signal `name`, which is Message.Signal, in the text of a database. Throws InputError
/// that names what is missing or wrong: no such message or signal, one that is multiplexed, or one
/// whose bits do not fit 64 bytes. `file` is for the error.
[[nodiscard]] DbcSignal find_dbc_signal(std::string_view text, const std::string& name,
                                        const std::string& file);

/// The speed signal, with factor, offset and range in m/s. Throws InputError that names the
/// setting, file or row: nothing stated, an unreadable file, no such signal, a unit that is no
/// speed.
[[nodiscard]] DbcSignal load_speed_signal(const VehicleSpeedConfig& config);

}  // namespace plumb
