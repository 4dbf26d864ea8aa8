/// A cursor over bytes from elsewhere. Reading beyond the end yields zeros and clears ok().
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace plumb {

class ByteCursor {
 public:
  explicit ByteCursor(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// A little-endian number of `size` bytes.
  std::uint64_t number(std::size_t size) {
    std::uint64_t value = 0;
    unsigned shift = 0;
    for (const std::uint8_t byte : take(size)) {
      value |= static_cast<std::uint64_t>(byte) << shift;
      shift += 8;
    }
    return value;
  }
  /// The next bytes; none when fewer are left.
  std::span<const std::uint8_t> take(std::uint64_t count) {
    if (!ok_ || count > bytes_.size() - at_) {
      ok_ = false;
      return {};
    }
    const auto part = bytes_.subspan(at_, static_cast<std::size_t>(count));
    at_ += part.size();
    return part;
  }
  /// A number of bytes (32 bits), then they.
  std::span<const std::uint8_t> blob() { return take(number(4)); }
  std::string_view text() {
    const auto part = blob();
    return {reinterpret_cast<const char*>(part.data()), part.size()};
  }
  /// Moves on to a multiple of `size` from the beginning.
  void align(std::size_t size) { (void)take((size - at_ % size) % size); }

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool at_end() const { return !ok_ || at_ == bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace plumb
