#include "modules/can/can_codec.hpp"

#include <cmath>

#include "modules/can/can_e2e.hpp"

namespace plumb {

std::uint64_t to_raw(const SignalLayout& layout, double physical) {
  const std::uint64_t absent = layout.has_sna ? sna_raw(layout) : 0;
  if (!std::isfinite(physical)) return absent;
  double raw = std::round((physical - layout.offset) / layout.factor);
  const std::uint64_t top = max_raw(layout);
  if (layout.beyond == Beyond::kWraps) {
    const double count = static_cast<double>(top) + 1.0;
    raw -= count * std::floor(raw / count);
    return raw < count ? static_cast<std::uint64_t>(raw) : 0;
  }
  if (raw < 0.0) return absent;
  if (raw > static_cast<double>(top)) return layout.beyond == Beyond::kStays ? top : absent;
  return static_cast<std::uint64_t>(raw);
}

bool is_sendable(const SignalLayout& layout, double physical) {
  return std::isfinite(physical) &&
         !(layout.has_sna && to_raw(layout, physical) == sna_raw(layout));
}

double to_physical(const SignalLayout& layout, std::uint64_t raw) {
  if (raw > max_raw(layout)) return kNotAvailable;
  return static_cast<double>(raw) * layout.factor + layout.offset;
}

void insert_raw(const SignalLayout& layout, std::uint64_t raw, std::span<std::uint8_t> data) {
  for (int i = 0; i < layout.length; ++i) {
    const unsigned at = bit_position(layout, i);
    const auto mask = static_cast<std::uint8_t>(1U << at % 8U);
    const bool one = (raw >> static_cast<unsigned>(i) & 1U) != 0;
    std::uint8_t& byte = data[at / 8U];
    byte = static_cast<std::uint8_t>(one ? byte | mask : byte & ~mask);
  }
}

std::uint64_t extract_raw(const SignalLayout& layout, std::span<const std::uint8_t> data) {
  std::uint64_t raw = 0;
  for (int i = 0; i < layout.length; ++i) {
    const unsigned at = bit_position(layout, i);
    const std::uint64_t bit = static_cast<unsigned>(data[at / 8U]) >> at % 8U & 1U;
    raw |= bit << static_cast<unsigned>(i);
  }
  return raw;
}

CanFrame encode(const Message& message, const MessageValues& values, const FrameFields& fields) {
  CanFrame frame;
  frame.id = message.address.id;
  frame.extended = message.address.extended;
  frame.size = kMessageBytes;
  const std::span<std::uint8_t> data(frame.data.data(), kMessageBytes);
  for (std::size_t i = 0; i < message.signals.size(); ++i) {
    const Signal& signal = message.signals[i];
    double value = values[i];
    if (is_framing(signal, Framing::kFrameCounter)) value = fields.frame_counter;
    if (is_framing(signal, Framing::kObjectIndex)) value = fields.object_index;
    insert_raw(signal.layout, to_raw(signal.layout, value), data);
  }
  e2e_protect(data, message.address.data_id, fields.alive);
  return frame;
}

bool decode(const Message& message, const CanFrame& frame, MessageValues* values) {
  if (frame.id != message.address.id || frame.extended != message.address.extended || frame.fd ||
      frame.size != kMessageBytes) {
    return false;
  }
  const std::span<const std::uint8_t> data(frame.data.data(), kMessageBytes);
  if (!e2e_check(data, message.address.data_id)) return false;
  for (std::size_t i = 0; i < message.signals.size(); ++i) {
    const SignalLayout& layout = message.signals[i].layout;
    (*values)[i] = to_physical(layout, extract_raw(layout, data));
  }
  return true;
}

}  // namespace plumb
