/// One frame as it travels on a CAN bus, and where frames go.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace plumb {

/// Classic CAN (up to 8 bytes) or CAN FD (up to 64).
struct CanFrame {
  std::uint32_t id = 0;   ///< 11-bit, or 29-bit when `extended`
  std::uint8_t size = 0;  ///< number of valid bytes in `data`
  bool extended = false;
  bool fd = false;  ///< CAN FD frame, sent with bit rate switch
  std::array<std::uint8_t, 64> data{};
};

/// A bus or a file that takes frames. `time_us` is the clock of whoever decides what is sent.
class CanSink {
 public:
  virtual ~CanSink() = default;
  virtual void send(std::int64_t time_us, const CanFrame& frame) = 0;
};

}  // namespace plumb
