/// What every CAN message carries: one table per message, one row per signal. A row states name,
/// bits, scale, unit, source, meaning and the names of values; codec, gates and DBC follow from it.
/// docs/add_a_signal.md shows how to add one.
#pragma once

#include <span>

#include "modules/can/can_signal.hpp"

namespace plumb {

[[nodiscard]] std::span<const SignalTable> motion_signals();
[[nodiscard]] std::span<const SignalTable> plane_signals();
[[nodiscard]] std::span<const SignalTable> frame_signals();
[[nodiscard]] std::span<const SignalTable> mount_signals();
[[nodiscard]] std::span<const SignalTable> status_signals();
[[nodiscard]] std::span<const SignalTable> object_signals();

/// All of them with the addresses of one configuration. Throws InputError, see can_addresses().
[[nodiscard]] Messages can_messages(const CanConfig& config);

}  // namespace plumb
