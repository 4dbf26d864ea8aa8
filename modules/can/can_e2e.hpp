/// AUTOSAR E2E profile 11, variant 11A. Byte 0 is a CRC-8, and the low half of byte 1 is an alive
/// counter 0..14. The 16-bit data ID enters the CRC and is not sent.
///
/// CRC:
///   Polynomial 0x1D (SAE J1850), start 0, no final xor. It runs over the low byte and the high
///   byte of the data ID, then over every byte of the frame after the CRC.
/// Source:
///   AUTOSAR, Specification of SW-C End-to-End Communication Protection Library, profile 11.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace plumb {

inline constexpr std::uint8_t kE2eCounterModulo = 15;  ///< 15 is never sent

/// CRC-8 with polynomial 0x1D, continued from `crc`.
[[nodiscard]] std::uint8_t crc8_1d(std::uint8_t crc, std::span<const std::uint8_t> bytes);

/// Writes counter and CRC. @pre data.size() >= 2, counter < kE2eCounterModulo
void e2e_protect(std::span<std::uint8_t> data, std::uint16_t data_id, std::uint8_t counter);

/// Returns whether the CRC fits and the counter is one that is ever sent.
[[nodiscard]] bool e2e_check(std::span<const std::uint8_t> data, std::uint16_t data_id);

}  // namespace plumb
