/// Physical values <-> CAN frames, as a message's table says.
///
/// Memory:
///   The functions keep nothing.
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

/// Returns the nearest raw value. NaN, infinity and a value beyond the range become "not
/// available", or 0 where the signal has no such value; see Beyond for signals that stay or wrap.
[[nodiscard]] std::uint64_t to_raw(const SignalLayout& layout, double physical);
/// Returns whether the value reaches a receiver.
[[nodiscard]] bool is_sendable(const SignalLayout& layout, double physical);
/// Returns NaN for "not available".
[[nodiscard]] double to_physical(const SignalLayout& layout, std::uint64_t raw);

/// @pre the signal lies inside `data`, raw < 2^length
void insert_raw(const SignalLayout& layout, std::uint64_t raw, std::span<std::uint8_t> data);
[[nodiscard]] std::uint64_t extract_raw(const SignalLayout& layout,
                                        std::span<const std::uint8_t> data);

/// Returns the message's frame with these values, counters and its CRC.
[[nodiscard]] CanFrame encode(const Message& message, const MessageValues& values,
                              const FrameFields& fields);

/// Reads every signal of the frame into `values`. Returns false and leaves `values` alone when
/// identifier, size, CRC or alive counter are not those of this message.
[[nodiscard]] bool decode(const Message& message, const CanFrame& frame, MessageValues* values);

}  // namespace plumb
