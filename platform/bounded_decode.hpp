/// Decoding of bytes nobody has checked: false for anything that is not exactly one sound message.
///
/// Messages of fixed size cannot make the generated decoder allocate or read beyond the bytes. A
/// message with strings or variable arrays can (a corrupt length makes it throw, or ask for
/// gigabytes), so each one has its lengths walked first. A new variable message does not compile
/// until it has its own overload.
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

/// Big-endian cursor over a message. Reading beyond the end yields 0 and clears ok().
class WireCursor {
 public:
  explicit WireCursor(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::int64_t i64() { return static_cast<std::int64_t>(big_endian(8)); }
  [[nodiscard]] std::int32_t i32() {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(big_endian(4)));
  }
  /// The next `count` bytes; empty, and ok() false, when they are not all there.
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
  /// Walks over an LCM string: i32 length that counts the closing zero, then the bytes.
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

[[nodiscard]] bool lengths_hold(std::span<const std::uint8_t> bytes, const detections_t*);
[[nodiscard]] bool lengths_hold(std::span<const std::uint8_t> bytes, const ground_plane_t*);
[[nodiscard]] bool lengths_hold(std::span<const std::uint8_t> bytes, const objects_t*);
[[nodiscard]] bool lengths_hold(std::span<const std::uint8_t> bytes, const process_health_t*);
template <typename Message>
requires std::is_trivially_copyable_v<Message>
[[nodiscard]] bool lengths_hold(std::span<const std::uint8_t> /*bytes*/, const Message*) {
  return true;
}

/// Decodes `bytes` into `message`. False, with `message` in an unspecified state, when they are not
/// exactly one message of this type. Never throws for what the bytes say.
template <typename Message>
[[nodiscard]] bool decode_bounded(std::span<const std::uint8_t> bytes, Message* message) {
  if (bytes.size() > 0x7FFFFFFFU || !lengths_hold(bytes, message)) return false;
  const int size = static_cast<int>(bytes.size());
  return message->decode(bytes.data(), 0, size) == size;
}

}  // namespace plumb
