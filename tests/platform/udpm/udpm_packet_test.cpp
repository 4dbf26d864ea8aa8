#include "platform/udpm/udpm_packet.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "tests/platform/udpm/packets.hpp"

namespace plumb {
namespace {

using test::Bytes;
using test::fragment_packet;
using test::FragmentFields;
using test::short_packet;

/// Parses a copy that ends where its memory ends, so that AddressSanitizer sees reads beyond.
UdpmOutcome parse(const Bytes& bytes, UdpmPacket* packet) {
  static std::unique_ptr<std::uint8_t[]> memory;
  memory.reset(new std::uint8_t[bytes.size()]);
  std::copy(bytes.begin(), bytes.end(), memory.get());
  return parse_udpm_packet({memory.get(), bytes.size()}, packet);
}

UdpmOutcome parse(const Bytes& bytes) {
  UdpmPacket packet;
  return parse(bytes, &packet);
}

Bytes with_channel(const std::string& channel, const Bytes& payload) {
  Bytes body = test::channel_bytes(channel);
  test::append(&body, payload);
  return body;
}

TEST(UdpmPacket, ParsesAShortMessage) {
  UdpmPacket packet;
  ASSERT_EQ(UdpmOutcome::kMessage, parse(short_packet(0xFEDCBA98, "EGO", {1, 0, 3}), &packet));
  EXPECT_FALSE(packet.is_fragment);
  EXPECT_EQ(0xFEDCBA98U, packet.sequence);
  EXPECT_EQ("EGO", packet.channel);
  EXPECT_EQ((Bytes{1, 0, 3}), Bytes(packet.payload.begin(), packet.payload.end()));
}

TEST(UdpmPacket, ParsesAMessageWithoutBytes) {
  UdpmPacket packet;
  ASSERT_EQ(UdpmOutcome::kMessage, parse(short_packet(0, "X", {}), &packet));
  EXPECT_TRUE(packet.payload.empty());
}

TEST(UdpmPacket, ParsesTheFirstAndALaterFragment) {
  UdpmPacket packet;
  const Bytes first = fragment_packet({7, 5, 0, 0, 2}, with_channel("CAMERA", {1, 2}));
  ASSERT_EQ(UdpmOutcome::kFragment, parse(first, &packet));
  EXPECT_TRUE(packet.is_fragment);
  EXPECT_EQ(7U, packet.sequence);
  EXPECT_EQ("CAMERA", packet.channel);
  EXPECT_EQ(5U, packet.message_bytes);
  EXPECT_EQ(2U, packet.payload.size());
  ASSERT_EQ(UdpmOutcome::kFragment, parse(fragment_packet({7, 5, 2, 1, 2}, {3, 4, 5}), &packet));
  EXPECT_TRUE(packet.channel.empty());
  EXPECT_EQ(2U, packet.offset);
  EXPECT_EQ(1U, packet.number);
  EXPECT_EQ(2U, packet.count);
  EXPECT_EQ((Bytes{3, 4, 5}), Bytes(packet.payload.begin(), packet.payload.end()));
}

TEST(UdpmPacket, RefusesPacketsThatAreCutAnywhere) {
  const Bytes whole = short_packet(1, "CAMERA", {});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_EQ(size < 8 ? UdpmOutcome::kTooShort : UdpmOutcome::kChannelUnterminated, parse(cut))
        << size;
  }
  const Bytes fragment = fragment_packet({1, 9, 0, 0, 2}, with_channel("CAMERA", {}));
  for (std::size_t size = 0; size < fragment.size(); ++size) {
    const Bytes cut(fragment.begin(), fragment.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_EQ(size < 20 ? UdpmOutcome::kTooShort : UdpmOutcome::kChannelUnterminated, parse(cut))
        << size;
  }
}

TEST(UdpmPacket, RefusesOtherProtocols) {
  Bytes packet = short_packet(1, "CAMERA", {1});
  for (std::size_t i = 0; i < 4; ++i) {
    Bytes other = packet;
    other[i] ^= 0x20U;
    EXPECT_EQ(UdpmOutcome::kUnknownMagic, parse(other)) << i;
  }
}

TEST(UdpmPacket, RefusesChannelsThatAreEmptyOrTooLong) {
  EXPECT_EQ(UdpmOutcome::kChannelEmpty, parse(short_packet(1, "", {1, 2})));
  EXPECT_EQ(UdpmOutcome::kMessage, parse(short_packet(1, std::string(63, 'C'), {1})));
  EXPECT_EQ(UdpmOutcome::kChannelTooLong, parse(short_packet(1, std::string(64, 'C'), {1})));
  EXPECT_EQ(UdpmOutcome::kChannelTooLong, parse(short_packet(1, std::string(60'000, 'C'), {})));
  EXPECT_EQ(UdpmOutcome::kChannelEmpty,
            parse(fragment_packet({1, 5, 0, 0, 2}, with_channel("", {1}))));
  EXPECT_EQ(UdpmOutcome::kChannelTooLong,
            parse(fragment_packet({1, 5, 0, 0, 2}, with_channel(std::string(64, 'C'), {1}))));
}

TEST(UdpmPacket, RefusesAFragmentNumberThatIsNotBelowTheCount) {
  EXPECT_EQ(UdpmOutcome::kFragmentNumber,
            parse(fragment_packet({1, 5, 0, 0, 0}, with_channel("CAMERA", {1}))));
  EXPECT_EQ(UdpmOutcome::kFragmentNumber, parse(fragment_packet({1, 5, 0, 2, 2}, {1})));
  EXPECT_EQ(UdpmOutcome::kFragmentNumber, parse(fragment_packet({1, 5, 0, 0xFFFF, 3}, {1})));
}

TEST(UdpmPacket, RefusesFragmentsThatReachBeyondTheirMessageAlsoWhereOffsetPlusSizeWraps) {
  EXPECT_EQ(UdpmOutcome::kFragment, parse(fragment_packet({1, 10, 6, 1, 3}, Bytes(4))));
  EXPECT_EQ(UdpmOutcome::kFragmentRange, parse(fragment_packet({1, 10, 7, 1, 3}, Bytes(4))));
  EXPECT_EQ(UdpmOutcome::kFragmentRange, parse(fragment_packet({1, 10, 11, 1, 3}, {})));
  for (const std::uint32_t offset : {0xFFFFFF00U, 0xFFFFFFF0U, 0xFFFFFFFFU}) {
    EXPECT_EQ(UdpmOutcome::kFragmentRange,
              parse(fragment_packet({77, 1024, offset, 1, 3}, Bytes(512))));
  }
  EXPECT_EQ(UdpmOutcome::kFragmentRange,
            parse(fragment_packet({1, 3, 0, 0, 2}, with_channel("CAMERA", Bytes(4)))));
}

TEST(UdpmPacket, RefusesAMessageThatDoesNotBeginWithItsFirstOrEndWithItsLastFragment) {
  EXPECT_EQ(UdpmOutcome::kInconsistent,
            parse(fragment_packet({1, 10, 1, 0, 2}, with_channel("CAMERA", Bytes(4)))));
  EXPECT_EQ(UdpmOutcome::kInconsistent, parse(fragment_packet({1, 10, 5, 1, 2}, Bytes(4))));
  EXPECT_EQ(UdpmOutcome::kInconsistent,
            parse(fragment_packet({1, 1024, 0, 0, 1}, with_channel("CAMERA", Bytes(10)))));
}

TEST(UdpmPacket, HeadersAreWrittenAsTheyAreParsed) {
  UdpmPacket fragment;
  fragment.sequence = 0x01020304;
  fragment.message_bytes = 0x05060708;
  fragment.offset = 0x090A0B0C;
  fragment.number = 0x0D0E;
  fragment.count = 0x0F10;
  const auto header = udpm_fragment_header(fragment);
  EXPECT_EQ(fragment_packet({0x01020304, 0x05060708, 0x090A0B0C, 0x0D0E, 0x0F10}, {}),
            Bytes(header.begin(), header.end()));
  const auto short_header = udpm_short_header(0xA1B2C3D4);
  Bytes packet(short_header.begin(), short_header.end());
  test::append(&packet, test::channel_bytes("X"));
  EXPECT_EQ(short_packet(0xA1B2C3D4, "X", {}), packet);
}

TEST(UdpmPacket, KnowsWhatIsAChannel) {
  EXPECT_TRUE(is_udpm_channel("CAMERA"));
  EXPECT_TRUE(is_udpm_channel(std::string(63, 'C')));
  EXPECT_FALSE(is_udpm_channel(std::string(64, 'C')));
  EXPECT_FALSE(is_udpm_channel(""));
  EXPECT_FALSE(is_udpm_channel(std::string("A\0B", 3)));
}

// A sound packet refers to bytes within the datagram, whatever was changed in it.
TEST(UdpmPacket, ParsedPartsLieInsideThePacketAfterRandomChanges) {
  std::mt19937 random(20240131);
  const std::vector<Bytes> samples{
      short_packet(1, "CAMERA", Bytes(40, 1)),
      fragment_packet({2, 100, 0, 0, 2}, with_channel("CAMERA", Bytes(50, 2))),
      fragment_packet({2, 100, 50, 1, 2}, Bytes(50, 3))};
  int num_sound = 0;
  for (int i = 0; i < 200'000; ++i) {
    Bytes bytes = samples[random() % samples.size()];
    for (unsigned k = random() % 4; k > 0; --k)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    if (random() % 4 == 0) bytes.resize(random() % bytes.size());
    UdpmPacket packet;
    const UdpmOutcome outcome = parse_udpm_packet(bytes, &packet);
    if (is_refusal(outcome)) continue;
    ++num_sound;
    ASSERT_GE(packet.payload.data(), bytes.data());
    ASSERT_LE(packet.payload.data() + packet.payload.size(), bytes.data() + bytes.size());
    if (!packet.is_fragment) continue;
    ASSERT_LT(packet.number, packet.count);
    ASSERT_LE(std::uint64_t{packet.offset} + packet.payload.size(), packet.message_bytes);
  }
  EXPECT_GT(num_sound, 20'000);
}

TEST(UdpmOutcome, HasATextForEachAndCountsRefusalsApart) {
  UdpmOutcomeCounts counts;
  for (std::size_t i = 0; i < kNumUdpmOutcomes; ++i) {
    const auto outcome = static_cast<UdpmOutcome>(i);
    ASSERT_NE(nullptr, describe(outcome));
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_STRNE(describe(static_cast<UdpmOutcome>(k)), describe(outcome));
    counts.add(outcome);
    EXPECT_EQ(1, counts[outcome]);
  }
  EXPECT_EQ(static_cast<std::int64_t>(kNumUdpmOutcomes) - 3, counts.num_refused());
}

TEST(UdpmPacket, ReadsBothBytesOfFragmentNumberAndCount) {
  const auto bytes = test::fragment_packet({7, 600'000, 300'000, 0x0102, 0x0304}, {1, 2, 3});
  UdpmPacket packet;
  ASSERT_EQ(UdpmOutcome::kFragment, parse_udpm_packet(bytes, &packet));
  EXPECT_EQ(0x0102, packet.number);
  EXPECT_EQ(0x0304, packet.count);
}

}  // namespace
}  // namespace plumb
