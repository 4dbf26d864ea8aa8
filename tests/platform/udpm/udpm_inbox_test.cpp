#include "platform/udpm/udpm_inbox.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "tests/platform/udpm/packets.hpp"

namespace plumb {
namespace {

using test::Bytes;
using test::fragment_packet;
using test::fragments_of;
using test::pattern;
using test::short_packet;

constexpr UdpmSource kSender{0x7F000001, 40'000};
constexpr std::size_t kImageBytes = 466'616;
constexpr std::size_t kStockPiece = 65'480;  // about what liblcm puts into a fragment

class UdpmInboxTest : public testing::Test {
 protected:
  UdpmOutcome take(const Bytes& packet, const UdpmSource& source = kSender,
                   std::int64_t arrival_us = 1) {
    return inbox_.take_packet(source, packet, arrival_us);
  }
  UdpmOutcome take_all(const std::vector<Bytes>& packets, const UdpmSource& source = kSender) {
    UdpmOutcome last = UdpmOutcome::kTooShort;
    for (const Bytes& packet : packets) last = take(packet, source);
    return last;
  }
  void expect_next(int subscription, const Bytes& payload) {
    const MessageQueues::View view = inbox_.pop();
    ASSERT_EQ(subscription, view.subscription);
    EXPECT_EQ(payload, Bytes(view.bytes.begin(), view.bytes.end()));
  }

  UdpmInbox inbox_;
  int image_ = inbox_.subscribe({"CAMERA", kImageBytes, 3});
  int motion_ = inbox_.subscribe({"VO_MOTION", 200, 8});
};

TEST_F(UdpmInboxTest, DeliversShortAndFragmentedMessagesInTheOrderOfCompletion) {
  const Bytes image = pattern(kImageBytes, 1);
  const auto packets = fragments_of(1, "CAMERA", image, kStockPiece);
  ASSERT_EQ(8U, packets.size());
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(UdpmOutcome::kFragment, take(packets[i]));
  EXPECT_EQ(UdpmOutcome::kMessage, take(short_packet(2, "VO_MOTION", Bytes(200, 7)), {1, 1}));
  EXPECT_TRUE(!inbox_.is_empty());
  EXPECT_EQ(UdpmOutcome::kMessage, take(packets[7], kSender, 99));
  expect_next(motion_, Bytes(200, 7));
  expect_next(image_, image);
  EXPECT_TRUE(inbox_.is_empty());
  EXPECT_EQ(2, inbox_.outcomes()[UdpmOutcome::kMessage]);
  EXPECT_EQ(7, inbox_.outcomes()[UdpmOutcome::kFragment]);
  EXPECT_EQ(0, inbox_.outcomes().num_refused());
}

TEST_F(UdpmInboxTest, TheTimeOfArrivalIsThatOfTheLastFragment) {
  const auto packets = fragments_of(1, "CAMERA", pattern(3'000, 1), 1'500);
  take(packets[0], kSender, 100);
  take(packets[1], kSender, 200);
  EXPECT_EQ(200, inbox_.pop().arrival_us);
}

TEST_F(UdpmInboxTest, AFragmentedMessageOfASmallChannelIsCopiedIntoItsSlot) {
  const Bytes payload = pattern(150, 4);
  EXPECT_EQ(UdpmOutcome::kMessage, take_all(fragments_of(1, "VO_MOTION", payload, 100)));
  expect_next(motion_, payload);
}

TEST_F(UdpmInboxTest, DropsWhatNobodyReadsWithoutTakingAPlace) {
  EXPECT_EQ(UdpmOutcome::kUnsubscribed, take(short_packet(1, "EGO_MOTION", {1})));
  const auto open = fragments_of(1, "CAMERA", pattern(3'000, 1), 1'500);
  take(open[0], {1, 1});
  for (std::uint32_t i = 0; i < 20; ++i) {
    EXPECT_EQ(UdpmOutcome::kUnsubscribed,
              take_all(fragments_of(i, "OTHER_CAMERA", pattern(4'000, 1), 1'000)));
  }
  EXPECT_EQ(UdpmOutcome::kMessage, take(open[1], {1, 1})) << "it was not displaced";
  EXPECT_EQ(0, inbox_.num_given_up());
  EXPECT_EQ(81, inbox_.outcomes()[UdpmOutcome::kUnsubscribed]);
}

TEST_F(UdpmInboxTest, AMessageWhoseChannelComesLastAndIsNotReadIsReleased) {
  const auto packets = fragments_of(1, "OTHER", pattern(3'000, 1), 1'000);
  EXPECT_EQ(UdpmOutcome::kFragment, take(packets[2]));
  EXPECT_EQ(UdpmOutcome::kUnsubscribed, take(packets[0]));
  EXPECT_EQ(UdpmOutcome::kUnsubscribed, take(packets[1]));
}

TEST_F(UdpmInboxTest, RefusesMessagesLargerThanTheirChannelAllows) {
  EXPECT_EQ(UdpmOutcome::kMessage, take(short_packet(1, "VO_MOTION", Bytes(200))));
  EXPECT_EQ(UdpmOutcome::kTooLarge, take(short_packet(2, "VO_MOTION", Bytes(201))));
  EXPECT_EQ(UdpmOutcome::kTooLarge, take_all(fragments_of(3, "VO_MOTION", Bytes(201), 150)));
  EXPECT_EQ(UdpmOutcome::kMessage, take_all(fragments_of(4, "VO_MOTION", Bytes(200), 150)));
  EXPECT_EQ(UdpmOutcome::kTooLarge,
            take_all(fragments_of(5, "CAMERA", Bytes(kImageBytes + 1), kStockPiece)));
  EXPECT_EQ(2, inbox_.outcomes()[UdpmOutcome::kMessage]);
}

TEST_F(UdpmInboxTest, AMessageOfAReaderWhoLeftIsDropped) {
  const auto packets = fragments_of(1, "CAMERA", pattern(3'000, 1), 1'500);
  take(packets[0]);
  inbox_.unsubscribe(image_);
  EXPECT_EQ(UdpmOutcome::kUnsubscribed, take(packets[1]));
  EXPECT_TRUE(inbox_.is_empty());
}

TEST_F(UdpmInboxTest, CountsWhatItsCallerRefused) {
  inbox_.count_refused(UdpmOutcome::kForeignSource);
  EXPECT_EQ(1, inbox_.outcomes()[UdpmOutcome::kForeignSource]);
  EXPECT_EQ(1, inbox_.outcomes().num_refused());
}

TEST_F(UdpmInboxTest, IsFullUntilAMessageIsReleased) {
  for (std::uint32_t i = 0; i < 8; ++i) {
    EXPECT_FALSE(inbox_.is_full());
    take(short_packet(i, "VO_MOTION", {1}));
  }
  EXPECT_TRUE(inbox_.is_full());
  EXPECT_EQ(motion_, inbox_.pop().subscription);
  inbox_.release();
  EXPECT_FALSE(inbox_.is_full());
}

TEST_F(UdpmInboxTest, CountsImagesThatWereSkippedForANewerOne) {
  const int latest = inbox_.subscribe({"LATEST", 10'000, 2, Delivery::kLatest});
  for (std::uint32_t i = 0; i < 5; ++i)
    take_all(fragments_of(i, "LATEST", pattern(5'000, i), 1'500));
  EXPECT_EQ(4, inbox_.num_skipped(latest));
  expect_next(latest, pattern(5'000, 4));
}

// Packets that killed processes built on liblcm, and their relatives.
TEST_F(UdpmInboxTest, SurvivesTheHostilePacketsOfTheField) {
  const Bytes camera = test::channel_bytes("CAMERA");
  Bytes begun = camera;
  begun.resize(begun.size() + 100, 'A');
  for (std::uint32_t i = 0; i < 300; ++i) {
    take(fragment_packet({i, 1'024, 0, 0, 3}, begun));
    take(fragment_packet({i, 1'024, 0xFFFFFF00, 1, 3}, Bytes(512)));  // offset + size wraps
    take(fragment_packet({i, 1'024, 5'000, 1, 3}, Bytes(512)));       // beyond the message
    take(fragment_packet({i + 1'000, 1'024, 0, 0, 0}, begun));        // no fragments
    take(fragment_packet({i + 2'000, 1'024, 0, 0, 1}, begun));        // 100 of 1024 bytes
    take(fragment_packet({i + 3'000, 0xFFFFFFFF, 0, 0, 2}, begun));   // 4 GiB
    take(fragment_packet({i + 4'000, 250U << 20U, 0, 0, 4'033}, begun));
    take(fragment_packet({i + 5'000, 1'024, 0, 0, 2}, Bytes(30, 'C')));  // channel has no NUL
    take(fragment_packet({i + 6'000, 1'024, 0, 0, 2}, {}));
    take(fragment_packet({i + 7'000, 60'000, 0, 0, 2}, begun), {1, static_cast<std::uint16_t>(i)});
  }
  EXPECT_EQ(0, inbox_.outcomes()[UdpmOutcome::kMessage]);
  const Bytes image = pattern(kImageBytes, 1);
  EXPECT_EQ(UdpmOutcome::kMessage, take_all(fragments_of(1, "CAMERA", image, kStockPiece), {2, 2}));
  expect_next(image_, image);
}

/// Sends several messages at once with their packets mixed, some lost, doubled or changed. What is
/// delivered must be a message that was sent, as long as nothing was changed.
class Mixer {
 public:
  Mixer(std::uint32_t seed, bool changes) : random_(seed), changes_(changes) {}

  std::vector<Bytes> packets(std::uint32_t first_sequence) {
    std::vector<Bytes> mixed;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t sequence = first_sequence + i;
      const std::size_t size = 2 + random_() % 9'000;
      const auto cut = fragments_of(sequence, "CAMERA", pattern(size, sequence),
                                    std::max<std::size_t>(size / (1 + random_() % 6), 1'024));
      for (const Bytes& packet : cut) add(packet, &mixed);
    }
    if (random_() % 2 == 0) std::shuffle(mixed.begin(), mixed.end(), random_);
    return mixed;
  }

 private:
  void add(Bytes packet, std::vector<Bytes>* mixed) {
    if (random_() % 16 == 0) return;
    if (changes_ && random_() % 4 == 0)
      packet[random_() % std::min<std::size_t>(packet.size(), 32)] =
          static_cast<std::uint8_t>(random_());
    if (changes_ && random_() % 16 == 0) packet.resize(random_() % packet.size());
    mixed->push_back(packet);
    if (random_() % 8 == 0) mixed->push_back(packet);
  }
  std::mt19937 random_;
  bool changes_;
};

TEST_F(UdpmInboxTest, DeliversOnlyWholeMessagesOutOfMixedLostAndDoubledPackets) {
  Mixer mixer(11, false);
  int num_delivered = 0;
  for (std::uint32_t sequence = 0; sequence < 6'000; sequence += 3) {
    for (const Bytes& packet : mixer.packets(sequence)) {
      if (take(packet) != UdpmOutcome::kMessage) continue;
      ++num_delivered;
      const MessageQueues::View view = inbox_.pop();
      const Bytes got(view.bytes.begin(), view.bytes.end());
      const bool was_sent = got == pattern(got.size(), sequence) ||
                            got == pattern(got.size(), sequence + 1) ||
                            got == pattern(got.size(), sequence + 2);
      ASSERT_TRUE(was_sent) << sequence;
      inbox_.release();
    }
  }
  EXPECT_GT(num_delivered, 3'000);
}

TEST_F(UdpmInboxTest, StaysInBoundsUnderRandomChangesAndCountsEachPacketOnce) {
  Mixer mixer(12, true);
  std::int64_t num_packets = 0;
  for (std::uint32_t sequence = 0; sequence < 6'000; sequence += 3) {
    for (const Bytes& packet : mixer.packets(sequence)) {
      ++num_packets;
      take(packet);
      while (inbox_.is_full()) {
        (void)inbox_.pop();
        inbox_.release();
      }
    }
  }
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < kNumUdpmOutcomes; ++i)
    sum += inbox_.outcomes()[static_cast<UdpmOutcome>(i)];
  EXPECT_EQ(num_packets, sum);
  EXPECT_GT(inbox_.outcomes()[UdpmOutcome::kMessage], 500);
  EXPECT_GT(inbox_.outcomes().num_refused(), 2'000);
}

}  // namespace
}  // namespace plumb
