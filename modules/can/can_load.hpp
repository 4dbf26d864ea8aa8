/// How much of a bus the messages use.
#pragma once

#include <cstddef>

#include "modules/can/can_signal.hpp"

namespace plumb {

/// Returns the largest number of bits that a frame of 8 bytes occupies: header, data, CRC, end of
/// frame, the pause after it, and as many stuff bits as ISO 11898-1 allows.
[[nodiscard]] constexpr int max_frame_bits(bool extended) {
  const int stuffed = (extended ? 54 : 34) + 8 * static_cast<int>(kMessageBytes);
  constexpr int kUnstuffed = 13;  // CRC delimiter, acknowledgement, end of frame, pause
  return stuffed + kUnstuffed + (stuffed - 1) / 4;
}

/// What makes frames leave between their cycles.
struct CanTraffic {
  double camera_hz = 10.0;      ///< camera frames, whose odometry does not wait for its cycle
  double objects_hz = 0.0;      ///< lists of objects
  std::size_t num_objects = 0;  ///< in each list
};

/// Returns the largest number of frames a second: all cycles, and all messages between them.
[[nodiscard]] double max_frames_per_s(const Messages& messages, const CanTraffic& traffic);

/// Returns the largest share of a bus with this bit rate; 1 is all of it.
[[nodiscard]] double max_bus_load(const Messages& messages, const CanTraffic& traffic,
                                  double bits_per_s);

}  // namespace plumb
