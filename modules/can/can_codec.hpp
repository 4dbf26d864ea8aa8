/// Physical values <-> CAN frames, as a message's table says.
///
/// Memory  values in, frame out; nothing is kept.
#pragma once

#include <cstdint>
#include <span>

#include "core/can_frame.hpp"
#include "modules/can/can_signal.hpp"

namespace plumb {

/// What a frame carries beside the values of its source.
struct FrameFields {
  std::uint8_t alive = 0;          ///< < kE2eCounterModulo
  std::uint8_t frame_counter = 0;  ///< seq modulo 256 of the camera frame
  std::uint8_t object_index = 0;   ///< in the list of objects
};

/// Nearest raw value; saturates, and NaN becomes "not available" (0 where the signal has none).
[[nodiscard]] std::uint64_t to_raw(const SignalLayout& layout, double physical);
/// NaN for "not available".
[[nodiscard]] double to_physical(const SignalLayout& layout, std::uint64_t raw);

/// @pre the signal lies inside `data`, raw < 2^length
void insert_raw(const SignalLayout& layout, std::uint64_t raw, std::span<std::uint8_t> data);
[[nodiscard]] std::uint64_t extract_raw(const SignalLayout& layout,
                                        std::span<const std::uint8_t> data);

/// The message's frame with these values, counters and CRC.
[[nodiscard]] CanFrame encode(const Message& message, const MessageValues& values,
                              const FrameFields& fields);

/// Reads every signal of the frame into `values`. False, leaving them alone, when identifier, size,
/// CRC or alive counter are not this message's.
[[nodiscard]] bool decode(const Message& message, const CanFrame& frame, MessageValues* values);

}  // namespace plumb
