/// What goes to the page in one WebSocket message.
///
/// Format:
///   u32 length of the JSON (little-endian) | JSON | JPEG, which may be empty.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace plumb {

struct Packet {
  /// Room in front of the message, into which the library writes the head of the WebSocket frame.
  static constexpr std::size_t kRoom = 64;

  std::vector<std::uint8_t> bytes;  ///< kRoom bytes, then the message
  std::int64_t id = -1;             ///< the page acknowledges it; -1: it does not

  [[nodiscard]] std::size_t size() const { return bytes.size() - kRoom; }
};

[[nodiscard]] inline std::shared_ptr<const Packet> make_packet(
    std::string_view json, std::span<const std::uint8_t> jpeg = {}, std::int64_t id = -1) {
  auto packet = std::make_shared<Packet>();
  packet->id = id;
  auto& bytes = packet->bytes;
  bytes.reserve(Packet::kRoom + 4 + json.size() + jpeg.size());
  bytes.resize(Packet::kRoom);
  for (unsigned shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<std::uint8_t>(json.size() >> shift));
  bytes.insert(bytes.end(), json.begin(), json.end());
  bytes.insert(bytes.end(), jpeg.begin(), jpeg.end());
  return packet;
}

}  // namespace plumb
