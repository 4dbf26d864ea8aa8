#include "modules/can/can_e2e.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string_view>

namespace plumb {
namespace {

using Bytes = std::array<std::uint8_t, 8>;

TEST(CanE2e, PolynomialGivesTheCatalogueCheckValueOfSaeJ1850) {
  // CRC-8/SAE-J1850: start 0xFF, final xor 0xFF, check value 0x4B for "123456789".
  constexpr std::string_view kDigits = "123456789";
  std::array<std::uint8_t, 9> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(kDigits[i]);
  EXPECT_EQ(crc8_1d(0xFF, bytes) ^ 0xFF, 0x4B);
}

TEST(CanE2e, EightZeroBytesMatchThePublishedVectors) {
  Bytes data{};
  e2e_protect(data, 0x123, 0);
  EXPECT_EQ(data, (Bytes{0xCC, 0x00}));
  e2e_protect(data, 0x123, 1);
  EXPECT_EQ(data, (Bytes{0x91, 0x01}));
}

TEST(CanE2e, ProtectingKeepsTheUpperHalfOfTheCounterByteAndAllOthers) {
  Bytes data{0xFF, 0xA5, 1, 2, 3, 4, 5, 6};
  e2e_protect(data, 0x3A01, 14);
  EXPECT_EQ(data[1], 0xAE);
  for (std::size_t i = 2; i < data.size(); ++i) EXPECT_EQ(data[i], i - 1);
  EXPECT_TRUE(e2e_check(data, 0x3A01));
}

TEST(CanE2e, EverySingleBitErrorIsFound) {
  Bytes data{0, 0x50, 0x12, 0x34, 0x56, 0x78, 0x9A, 0xBC};
  e2e_protect(data, 0x3A05, 7);
  ASSERT_TRUE(e2e_check(data, 0x3A05));
  for (std::size_t bit = 0; bit < 64; ++bit) {
    Bytes broken = data;
    broken[bit / 8] = static_cast<std::uint8_t>(broken[bit / 8] ^ (1U << bit % 8));
    EXPECT_FALSE(e2e_check(broken, 0x3A05)) << "bit " << bit;
  }
}

TEST(CanE2e, AnotherMessagesDataIdIsFound) {
  Bytes data{};
  e2e_protect(data, 0x3A01, 0);
  EXPECT_FALSE(e2e_check(data, 0x3A02));
  EXPECT_FALSE(e2e_check(data, 0x3B01));
}

TEST(CanE2e, ACounterThatIsNeverSentIsRefusedEvenWithAGoodCrc) {
  Bytes data{};
  e2e_protect(data, 0x3A01, 15);
  EXPECT_FALSE(e2e_check(data, 0x3A01));
}

TEST(CanE2e, AFrameTooShortForCrcAndCounterIsRefused) {
  const std::array<std::uint8_t, 1> data{};
  EXPECT_FALSE(e2e_check(data, 0));
  EXPECT_FALSE(e2e_check({}, 0));
}

}  // namespace
}  // namespace plumb
