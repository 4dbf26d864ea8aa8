/// Datagrams of LCM's wire format, written byte by byte so that tests do not trust our own writer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "platform/udpm/reassembly.hpp"

namespace plumb::test {

using Bytes = std::vector<std::uint8_t>;

inline void append_number(Bytes* bytes, std::uint64_t value, int size) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8)
    bytes->push_back(static_cast<std::uint8_t>(value >> static_cast<unsigned>(shift)));
}

inline void append(Bytes* bytes, const Bytes& more) {
  bytes->insert(bytes->end(), more.begin(), more.end());
}

/// `text` with its NUL.
inline Bytes channel_bytes(const std::string& text) {
  Bytes bytes(text.begin(), text.end());
  bytes.push_back(0);
  return bytes;
}

inline Bytes short_packet(std::uint32_t sequence, const std::string& channel,
                          const Bytes& payload) {
  Bytes bytes{'L', 'C', '0', '2'};
  append_number(&bytes, sequence, 4);
  append(&bytes, channel_bytes(channel));
  append(&bytes, payload);
  return bytes;
}

struct FragmentFields {
  std::uint32_t sequence = 0;
  std::uint32_t message_bytes = 0;
  std::uint32_t offset = 0;
  std::uint32_t number = 0;  ///< the lower 16 bits are sent
  std::uint32_t count = 0;   ///< the lower 16 bits are sent
};

/// `body` includes the channel in fragment 0.
inline Bytes fragment_packet(const FragmentFields& fields, const Bytes& body) {
  Bytes bytes{'L', 'C', '0', '3'};
  append_number(&bytes, fields.sequence, 4);
  append_number(&bytes, fields.message_bytes, 4);
  append_number(&bytes, fields.offset, 4);
  append_number(&bytes, fields.number, 2);
  append_number(&bytes, fields.count, 2);
  append(&bytes, body);
  return bytes;
}

/// `size` bytes that differ from message to message and along each message.
inline Bytes pattern(std::size_t size, std::uint32_t seed) {
  Bytes bytes(size);
  std::uint32_t state = seed * 2654435761U + 1;
  for (std::uint8_t& byte : bytes) {
    state = state * 1664525U + 1013904223U;
    byte = static_cast<std::uint8_t>(state >> 24U);
  }
  return bytes;
}

/// All fragments of a message, in pieces of `piece` bytes of payload.
inline std::vector<Bytes> fragments_of(std::uint32_t sequence, const std::string& channel,
                                       const Bytes& payload, std::size_t piece) {
  std::vector<Bytes> packets;
  const std::size_t count = (payload.size() + piece - 1) / piece;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t begin = k * piece;
    const std::size_t end = std::min(begin + piece, payload.size());
    Bytes body = k == 0 ? channel_bytes(channel) : Bytes{};
    body.insert(body.end(), payload.begin() + static_cast<std::ptrdiff_t>(begin),
                payload.begin() + static_cast<std::ptrdiff_t>(end));
    packets.push_back(fragment_packet(
        {sequence, static_cast<std::uint32_t>(payload.size()), static_cast<std::uint32_t>(begin),
         static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(count)},
        body));
  }
  return packets;
}

}  // namespace plumb::test
