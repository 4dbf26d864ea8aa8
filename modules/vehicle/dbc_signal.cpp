#include "modules/vehicle/dbc_signal.hpp"

#include <cmath>

namespace plumb {

int DbcSignal::place_of_bit(int i) const {
  if (is_intel) return start_bit + i;
  const int from_top = num_bits - 1 - i;
  const int linear = 8 * (start_bit / 8) + (7 - start_bit % 8) + from_top;
  return 8 * (linear / 8) + (7 - linear % 8);
}

std::optional<double> DbcSignal::value(const CanFrame& frame) const {
  if (frame.id != id || frame.extended != extended) return std::nullopt;
  std::uint64_t raw = 0;
  for (int i = 0; i < num_bits; ++i) {
    const auto place = static_cast<std::size_t>(place_of_bit(i));
    if (place / 8 >= frame.size) return std::nullopt;
    const std::uint64_t bit = (frame.data[place / 8] >> (place % 8)) & 1U;
    raw |= bit << i;
  }
  double number = static_cast<double>(raw);
  if (is_signed) {
    const int unused = 64 - num_bits;
    number = static_cast<double>(static_cast<std::int64_t>(raw << unused) >> unused);
  }
  const double physical = factor * number + offset;
  const bool ranged = min != 0.0 || max != 0.0;
  if (ranged && !(physical >= min && physical <= max)) return std::nullopt;
  if (!std::isfinite(physical)) return std::nullopt;
  return physical;
}

}  // namespace plumb
