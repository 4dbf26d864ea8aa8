#include "modules/can/can_e2e.hpp"

#include <array>

namespace plumb {
namespace {

constexpr std::array<std::uint8_t, 256> make_table() {
  std::array<std::uint8_t, 256> table{};
  for (unsigned i = 0; i < table.size(); ++i) {
    unsigned crc = i;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x80U) != 0 ? (crc << 1U) ^ 0x1DU : crc << 1U;
    table[i] = static_cast<std::uint8_t>(crc);
  }
  return table;
}

constexpr std::array<std::uint8_t, 256> kTable = make_table();

std::uint8_t frame_crc(std::span<const std::uint8_t> data, std::uint16_t data_id) {
  const std::array<std::uint8_t, 2> id = {static_cast<std::uint8_t>(data_id & 0xFFU),
                                          static_cast<std::uint8_t>(data_id >> 8U)};
  return crc8_1d(crc8_1d(0, id), data.subspan(1));
}

}  // namespace

std::uint8_t crc8_1d(std::uint8_t crc, std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) crc = kTable[crc ^ byte];
  return crc;
}

void e2e_protect(std::span<std::uint8_t> data, std::uint16_t data_id, std::uint8_t counter) {
  data[1] = static_cast<std::uint8_t>((data[1] & 0xF0U) | counter);
  data[0] = frame_crc(data, data_id);
}

bool e2e_check(std::span<const std::uint8_t> data, std::uint16_t data_id) {
  return data.size() >= 2 && (data[1] & 0x0FU) < kE2eCounterModulo &&
         data[0] == frame_crc(data, data_id);
}

}  // namespace plumb
