/// Decodes bytes from an untrusted source.
///
/// A message of fixed size cannot make the generated decoder allocate or read beyond the bytes. A
/// message with strings or variable arrays can: a corrupt length makes the decoder throw or request
/// gigabytes. Therefore the lengths in such a message are checked before it is decoded. A new
/// message of variable size does not compile until it has its own overload of lengths_are_valid().
///
/// Errors:
///   decode_bounded() returns false for anything but exactly one message. It never throws because
///   of what the bytes contain.
/// Memory:
///   Fixed-size messages allocate nothing. Others allocate what their checked lengths require.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "plumb/detections_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/objects_t.hpp"
#include "plumb/process_health_t.hpp"

namespace plumb {

/// A big-endian cursor over a message. Reading beyond the end yields 0 and clears ok().
class WireCursor {
 public:
  explicit WireCursor(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::int64_t i64() { return static_cast<std::int64_t>(big_endian(8)); }
  [[nodiscard]] std::int32_t i32() {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(big_endian(4)));
  }
  /// Takes the next `count` bytes. When fewer are left, the result is empty and ok() is cleared.
  [[nodiscard]] std::span<const std::uint8_t> take(std::int64_t count) {
    if (!ok_ || count < 0 || count > static_cast<std::int64_t>(bytes_.size() - position_)) {
      ok_ = false;
      return {};
    }
    const auto part = bytes_.subspan(position_, static_cast<std::size_t>(count));
    position_ += part.size();
    return part;
  }
  void skip(std::int64_t count) { (void)take(count); }
  /// Takes an LCM string: an i32 length that includes the terminating zero, then the bytes.
  [[nodiscard]] std::span<const std::uint8_t> text() {
    const std::int32_t length = i32();
    const auto part = take(length);
    if (part.empty() || part.back() != 0) {
      ok_ = false;
      return {};
    }
    return part.first(part.size() - 1);
  }
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool at_end() const { return ok_ && position_ == bytes_.size(); }

 private:
  std::uint64_t big_endian(std::int64_t count) {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : take(count)) value = (value << 8U) | byte;
    return value;
  }
  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

/// True when every length in `bytes` is within the limits of the message and of `bytes`.
[[nodiscard]] bool lengths_are_valid(std::span<const std::uint8_t> bytes, const detections_t*);
[[nodiscard]] bool lengths_are_valid(std::span<const std::uint8_t> bytes, const ground_plane_t*);
[[nodiscard]] bool lengths_are_valid(std::span<const std::uint8_t> bytes, const objects_t*);
[[nodiscard]] bool lengths_are_valid(std::span<const std::uint8_t> bytes, const process_health_t*);
template <typename Message>
requires std::is_trivially_copyable_v<Message>
[[nodiscard]] bool lengths_are_valid(std::span<const std::uint8_t> /*bytes*/, const Message*) {
  return true;
}

/// Decodes `bytes` into `message`. Returns false and leaves `message` unspecified when the bytes
/// are not exactly one message of this type.
template <typename Message>
[[nodiscard]] bool decode_bounded(std::span<const std::uint8_t> bytes, Message* message) {
  if (bytes.size() > 0x7FFFFFFFU || !lengths_are_valid(bytes, message)) return false;
  const int size = static_cast<int>(bytes.size());
  return message->decode(bytes.data(), 0, size) == size;
}

}  // namespace plumb
