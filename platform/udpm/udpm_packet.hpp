/// The wire format of LCM's UDP multicast provider (UDPM): parsing and writing of packet headers.
///
/// Format (numbers are big-endian):
///   short     "LC02" | u32 sequence | channel NUL | payload
///   fragment  "LC03" | u32 sequence | u32 message size | u32 offset | u16 number | u16 count
///             | channel NUL (only in fragment 0) | payload
/// Memory:
///   A parsed packet refers to the bytes that it was parsed from. Nothing is allocated.
/// Errors:
///   Each length is checked before it is used. A packet that fails a check has a fault and nothing
///   else in it may be used.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "platform/udpm/udpm_outcome.hpp"

namespace plumb {

inline constexpr std::size_t kUdpmMaxDatagram = 65'507;   ///< [bytes] the limit of UDP over IPv4
inline constexpr std::size_t kUdpmShortHeader = 8;        ///< [bytes]
inline constexpr std::size_t kUdpmFragmentHeader = 20;    ///< [bytes]
inline constexpr std::size_t kUdpmMaxChannelLength = 63;  ///< characters before the NUL
/// [bytes] Channel, NUL and payload of the longest short message, as in liblcm.
inline constexpr std::size_t kUdpmMaxShortBody = kUdpmMaxDatagram - kUdpmShortHeader;
/// [bytes] What follows the header of a full fragment, as in liblcm.
inline constexpr std::size_t kUdpmMaxFragmentBody = kUdpmMaxDatagram - kUdpmFragmentHeader;

/// One packet, parsed.
struct UdpmPacket {
  bool is_fragment = false;
  std::uint32_t sequence = 0;
  std::string_view channel;               ///< empty in fragments after the first
  std::span<const std::uint8_t> payload;  ///< the part of the message that this packet carries
  // Fragments only. Checked: number < count, offset + payload <= message_bytes, the first fragment
  // begins at 0, the last one ends at message_bytes.
  std::uint32_t message_bytes = 0;
  std::uint32_t offset = 0;
  std::uint16_t number = 0;
  std::uint16_t count = 0;
};

/// Parses one datagram into `packet`. Returns kMessage for a sound short packet, kFragment for a
/// sound fragment, otherwise the reason for refusing it.
[[nodiscard]] UdpmOutcome parse_udpm_packet(std::span<const std::uint8_t> bytes,
                                            UdpmPacket* packet);

/// Is `channel` a name that fits into a packet?
[[nodiscard]] bool is_udpm_channel(std::string_view channel);

[[nodiscard]] std::array<std::uint8_t, kUdpmShortHeader> udpm_short_header(std::uint32_t sequence);
/// Writes the header of `packet`, which is a fragment.
[[nodiscard]] std::array<std::uint8_t, kUdpmFragmentHeader> udpm_fragment_header(
    const UdpmPacket& packet);

}  // namespace plumb
