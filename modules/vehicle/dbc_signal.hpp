/// One signal of a CAN database, and its value in a frame.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/can_frame.hpp"

namespace plumb {

struct DbcSignal {
  std::uint32_t id = 0;
  bool extended = false;
  int start_bit =
      0;  ///< as the file counts: the least significant bit (Intel), the most (Motorola)
  int num_bits = 0;
  bool is_intel = true;
  bool is_signed = false;
  double factor = 1.0;
  double offset = 0.0;
  double min = 0.0;
  double max = 0.0;  ///< both 0: the file states no range
  std::string unit;

  /// The place in the frame of bit `i` of the signal, counted from its least significant one; bit
  /// 8 b + k of a frame is bit k of byte b. A Motorola signal goes from its most significant bit
  /// down through each byte.
  [[nodiscard]] int place_of_bit(int i) const;
  /// The physical value, in the signal's unit. Nothing when the frame is another one, is too short,
  /// or carries a value outside the stated range, with which vehicles mark what they do not know.
  [[nodiscard]] std::optional<double> value(const CanFrame& frame) const;
};

}  // namespace plumb
