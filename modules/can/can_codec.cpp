#include "modules/can/can_codec.hpp"

#include <cmath>

#include "modules/can/can_e2e.hpp"

namespace plumb {
namespace {

/// Position in `data` of bit `i` of the raw value, counted from its least significant bit.
unsigned bit_position(const Signal& signal, int i) {
  if (signal.order == ByteOrder::kIntel) return static_cast<unsigned>(signal.start_bit + i);
  // Motorola counts from the most significant bit down, and on to the next byte's bit 7. With bytes
  // mirrored (7 - bit) that walk is one straight line.
  const int sawtooth = signal.start_bit / 8 * 8 + 7 - signal.start_bit % 8;
  const int straight = sawtooth + signal.length - 1 - i;
  return static_cast<unsigned>(straight / 8 * 8 + 7 - straight % 8);
}

}  // namespace

std::uint64_t to_raw(const Signal& signal, double physical) {
  if (std::isnan(physical)) return signal.has_sna ? max_raw(signal) + 1 : 0;
  const double raw = std::round((physical - signal.offset) / signal.factor);
  const std::uint64_t top = max_raw(signal);
  if (raw <= 0.0) return 0;
  if (raw >= static_cast<double>(top)) return top;
  return static_cast<std::uint64_t>(raw);
}

double to_physical(const Signal& signal, std::uint64_t raw) {
  if (raw > max_raw(signal)) return kNotAvailable;
  return static_cast<double>(raw) * signal.factor + signal.offset;
}

void insert_raw(const Signal& signal, std::uint64_t raw, std::span<std::uint8_t> data) {
  for (int i = 0; i < signal.length; ++i) {
    const unsigned at = bit_position(signal, i);
    const auto mask = static_cast<std::uint8_t>(1U << at % 8U);
    const bool one = (raw >> static_cast<unsigned>(i) & 1U) != 0;
    std::uint8_t& byte = data[at / 8U];
    byte = static_cast<std::uint8_t>(one ? byte | mask : byte & ~mask);
  }
}

std::uint64_t extract_raw(const Signal& signal, std::span<const std::uint8_t> data) {
  std::uint64_t raw = 0;
  for (int i = 0; i < signal.length; ++i) {
    const unsigned at = bit_position(signal, i);
    const std::uint64_t bit = static_cast<unsigned>(data[at / 8U]) >> at % 8U & 1U;
    raw |= bit << static_cast<unsigned>(i);
  }
  return raw;
}

CanFrame encode(const Message& message, const CanValues& values, std::uint8_t alive) {
  CanFrame frame;
  frame.id = message.id;
  frame.size = kMessageBytes;
  const std::span<std::uint8_t> data(frame.data.data(), kMessageBytes);
  for (const Signal& signal : message.signals) {
    if (signal.value != nullptr) insert_raw(signal, to_raw(signal, values.*signal.value), data);
  }
  e2e_protect(data, message.data_id, alive);
  return frame;
}

bool decode(const Message& message, const CanFrame& frame, CanValues* values) {
  if (frame.id != message.id || frame.extended || frame.fd || frame.size != kMessageBytes) {
    return false;
  }
  const std::span<const std::uint8_t> data(frame.data.data(), kMessageBytes);
  if (!e2e_check(data, message.data_id)) return false;
  for (const Signal& signal : message.signals) {
    if (signal.value != nullptr) {
      values->*signal.value = to_physical(signal, extract_raw(signal, data));
    }
  }
  return true;
}

}  // namespace plumb
