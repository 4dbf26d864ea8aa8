#include "platform/udpm/udpm_packet.hpp"

#include <algorithm>

namespace plumb {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint32_t kShortMagic = 0x4C433032;     // "LC02"
constexpr std::uint32_t kFragmentMagic = 0x4C433033;  // "LC03"

/// @pre `at` + 4 <= bytes.size()
std::uint32_t get_u32(Bytes bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) << 24U |
         static_cast<std::uint32_t>(bytes[at + 1]) << 16U |
         static_cast<std::uint32_t>(bytes[at + 2]) << 8U | bytes[at + 3];
}

/// @pre `at` + 2 <= bytes.size()
std::uint16_t get_u16(Bytes bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8U | bytes[at + 1]);
}

void put_u32(std::uint8_t* at, std::uint32_t value) {
  at[0] = static_cast<std::uint8_t>(value >> 24U);
  at[1] = static_cast<std::uint8_t>(value >> 16U);
  at[2] = static_cast<std::uint8_t>(value >> 8U);
  at[3] = static_cast<std::uint8_t>(value);
}

void put_u16(std::uint8_t* at, std::uint16_t value) {
  at[0] = static_cast<std::uint8_t>(value >> 8U);
  at[1] = static_cast<std::uint8_t>(value);
}

/// Splits `body` into channel and payload. Returns `sound` when the channel is as it should be.
UdpmOutcome split_channel(Bytes body, UdpmOutcome sound, UdpmPacket* packet) {
  const Bytes head = body.first(std::min(body.size(), kUdpmMaxChannelLength + 1));
  const auto nul = std::find(head.begin(), head.end(), std::uint8_t{0});
  if (nul == head.end()) {
    return head.size() > kUdpmMaxChannelLength ? UdpmOutcome::kChannelTooLong
                                               : UdpmOutcome::kChannelUnterminated;
  }
  const auto length = static_cast<std::size_t>(nul - head.begin());
  if (length == 0) return UdpmOutcome::kChannelEmpty;
  packet->channel = {reinterpret_cast<const char*>(body.data()), length};
  packet->payload = body.subspan(length + 1);
  return sound;
}

UdpmOutcome parse_fragment(Bytes bytes, UdpmPacket* packet) {
  if (bytes.size() < kUdpmFragmentHeader) return UdpmOutcome::kTooShort;
  packet->is_fragment = true;
  packet->message_bytes = get_u32(bytes, 8);
  packet->offset = get_u32(bytes, 12);
  packet->number = get_u16(bytes, 16);
  packet->count = get_u16(bytes, 18);
  packet->payload = bytes.subspan(kUdpmFragmentHeader);
  if (packet->number >= packet->count) return UdpmOutcome::kFragmentNumber;
  if (packet->number == 0) {
    const UdpmOutcome split = split_channel(packet->payload, UdpmOutcome::kFragment, packet);
    if (split != UdpmOutcome::kFragment) return split;
  }
  // 64 bits: the sum of two hostile 32-bit numbers would wrap.
  const std::uint64_t end = std::uint64_t{packet->offset} + packet->payload.size();
  if (end > packet->message_bytes) return UdpmOutcome::kFragmentRange;
  const bool is_last = packet->number + 1 == packet->count;
  if (packet->number == 0 && packet->offset != 0) return UdpmOutcome::kInconsistent;
  if (is_last && end != packet->message_bytes) return UdpmOutcome::kInconsistent;
  return UdpmOutcome::kFragment;
}

}  // namespace

UdpmOutcome parse_udpm_packet(Bytes bytes, UdpmPacket* packet) {
  *packet = {};
  if (bytes.size() < kUdpmShortHeader) return UdpmOutcome::kTooShort;
  packet->sequence = get_u32(bytes, 4);
  switch (get_u32(bytes, 0)) {
    case kShortMagic:
      return split_channel(bytes.subspan(kUdpmShortHeader), UdpmOutcome::kMessage, packet);
    case kFragmentMagic:
      return parse_fragment(bytes, packet);
    default:
      return UdpmOutcome::kUnknownMagic;
  }
}

bool is_udpm_channel(std::string_view channel) {
  return !channel.empty() && channel.size() <= kUdpmMaxChannelLength &&
         channel.find('\0') == std::string_view::npos;
}

std::array<std::uint8_t, kUdpmShortHeader> udpm_short_header(std::uint32_t sequence) {
  std::array<std::uint8_t, kUdpmShortHeader> header{};
  put_u32(&header[0], kShortMagic);
  put_u32(&header[4], sequence);
  return header;
}

std::array<std::uint8_t, kUdpmFragmentHeader> udpm_fragment_header(const UdpmPacket& packet) {
  std::array<std::uint8_t, kUdpmFragmentHeader> header{};
  put_u32(&header[0], kFragmentMagic);
  put_u32(&header[4], packet.sequence);
  put_u32(&header[8], packet.message_bytes);
  put_u32(&header[12], packet.offset);
  put_u16(&header[16], packet.number);
  put_u16(&header[18], packet.count);
  return header;
}

}  // namespace plumb
