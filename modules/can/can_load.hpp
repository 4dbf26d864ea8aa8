/// How much of a bus the messages take.
#pragma once

#include <cstddef>

#include "modules/can/can_signal.hpp"

namespace plumb {

/// Bits that a frame of 8 bytes occupies at most: header, data, CRC, end of frame, the pause after
/// it, and a stuff bit for every 4 bits (ISO 11898-1).
[[nodiscard]] constexpr int max_frame_bits(bool extended) {
  const int stuffed = (extended ? 54 : 34) + 8 * static_cast<int>(kMessageBytes);
  constexpr int kUnstuffed = 13;  // CRC delimiter, acknowledgement, end of frame, pause
  return stuffed + kUnstuffed + (stuffed - 1) / 4;
}

/// What sends frames, from outside the cycles.
struct CanTraffic {
  double camera_hz = 10.0;      ///< camera frames, whose odometry does not wait for its cycle
  double objects_hz = 0.0;      ///< lists of objects
  std::size_t num_objects = 0;  ///< in each list
};

/// Frames a second at most: every cycle, and every message that leaves between its cycles.
[[nodiscard]] double max_frames_per_s(const Messages& messages, const CanTraffic& traffic);

/// Share of a bus with this bit rate, at most; 1 is all of it.
[[nodiscard]] double max_bus_load(const Messages& messages, const CanTraffic& traffic,
                                  double bits_per_s);

}  // namespace plumb
