/// Rows that every message has: its protection, and what ties it to a camera frame.
#pragma once

#include <cstdint>

#include "modules/can/can_signal.hpp"

namespace plumb {

constexpr Signal crc(const char* name) {
  return {name,
          {0, 8, 1.0, 0.0, false},
          "",
          {Framing::kCrc},
          "CRC-8 of AUTOSAR E2E profile 11A: polynomial 0x1D, start 0, no final xor, over the low "
          "byte and the high byte of E2EDataID, then bytes 1 to 7 of the frame."};
}

constexpr Signal alive_counter(const char* name) {
  return {name,
          {8, 4},
          "",
          {Framing::kAliveCounter},
          "Alive counter 0 to 14, +1 with every transmission of this message; 15 is never sent."};
}

constexpr Signal frame_counter(const char* name) {
  return {
      name,
      {16, 8, 1.0, 0.0, false},
      "",
      {Framing::kFrameCounter},
      "Low 8 bits of the camera frame's sequence number; messages with the same value belong to "
      "the same camera frame. All 256 values are counts, there is no value for not available."};
}

/// When a validity is "not available".
inline constexpr const char* kNoFreshInput =
    "there is no input, it is too old, or its age is not known";

/// A counter that never reaches 255, which stands for "not available".
constexpr std::uint32_t modulo_255(std::uint32_t count) { return count % 255U; }

}  // namespace plumb
