/// Serialises ROS 2 messages: CDR, little-endian (OMG DDSI-RTPS, XCDR1). Numbers are aligned to
/// their size, counted from the end of the four bytes of the encapsulation header.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace plumb {

class CdrWriter {
 public:
  static_assert(std::endian::native == std::endian::little);

  void u8(std::uint8_t value) { bytes_.push_back(value); }
  void i32(std::int32_t value) { number(value); }
  void u32(std::uint32_t value) { number(value); }
  void f64(double value) { number(value); }
  /// The length with the final zero, then the characters and the zero.
  void text(std::string_view value) {
    u32(static_cast<std::uint32_t>(value.size() + 1));
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    u8(0);
  }
  /// A sequence of bytes: their number, then they.
  void blob(std::span<const std::uint8_t> value) {
    u32(static_cast<std::uint32_t>(value.size()));
    bytes_.insert(bytes_.end(), value.begin(), value.end());
  }
  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  template <typename Number>
  void number(Number value) {
    while ((bytes_.size() - kHeaderBytes) % sizeof value != 0) bytes_.push_back(0);
    const auto* begin = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), begin, begin + sizeof value);
  }
  static constexpr std::size_t kHeaderBytes = 4;
  std::vector<std::uint8_t> bytes_ = {0x00, 0x01, 0x00, 0x00};  // CDR_LE, no options
};

}  // namespace plumb
