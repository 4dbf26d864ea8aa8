#include "platform/udpm/reassembly.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/platform/udpm/packets.hpp"

namespace plumb {
namespace {

using test::Bytes;
using test::fragment_packet;
using test::fragments_of;
using test::pattern;

constexpr UdpmSource kSender{0x7F000001, 40'000};
constexpr int kChannelNumber = 3;
constexpr std::size_t kMaxBytes = 10'000;
constexpr std::uint32_t kPiece = 1'500;

class ReassemblyTest : public testing::Test {
 protected:
  ReassemblyTest() { reassembly_.reserve(kMaxBytes); }

  Reassembly::Result add(const Bytes& bytes, const UdpmSource& source = kSender) {
    UdpmPacket packet;
    EXPECT_EQ(UdpmOutcome::kFragment, parse_udpm_packet(bytes, &packet));
    const UdpmOutcome closed = reassembly_.closed_outcome(source, packet.sequence);
    if (closed != UdpmOutcome::kFragment) return {closed};
    return reassembly_.add(source, packet,
                           packet.number == 0 ? kChannelNumber : Reassembly::kNoChannel);
  }
  void expect_complete(const Reassembly::Result& result, const Bytes& payload) {
    ASSERT_EQ(UdpmOutcome::kMessage, result.outcome);
    ASSERT_NE(nullptr, result.complete);
    EXPECT_EQ(kChannelNumber, result.complete->channel);
    ASSERT_EQ(payload.size(), result.complete->bytes);
    EXPECT_TRUE(std::equal(payload.begin(), payload.end(), result.complete->buffer.begin()));
  }

  Reassembly reassembly_{3};
};

TEST_F(ReassemblyTest, PutsFragmentsTogetherInAnyOrder) {
  std::mt19937 random(5);
  std::vector<std::size_t> order{0, 1, 2, 3, 4, 5};
  for (std::uint32_t sequence = 0; sequence < 200; ++sequence) {
    const Bytes payload = pattern(5 * kPiece + 7, sequence);
    const auto packets = fragments_of(sequence, "CAMERA", payload, kPiece);
    ASSERT_EQ(order.size(), packets.size());
    for (std::size_t i = 0; i + 1 < order.size(); ++i)
      ASSERT_EQ(UdpmOutcome::kFragment, add(packets[order[i]]).outcome);
    expect_complete(add(packets[order.back()]), payload);
    std::shuffle(order.begin(), order.end(), random);
  }
  EXPECT_EQ(0, reassembly_.num_given_up());
}

TEST_F(ReassemblyTest, TakesAMessageOfOneFragmentAndOneWithoutBytes) {
  const Bytes payload = pattern(100, 1);
  expect_complete(add(fragments_of(1, "CAMERA", payload, kPiece)[0]), payload);
  expect_complete(add(fragment_packet({2, 0, 0, 0, 1}, test::channel_bytes("CAMERA"))), {});
}

TEST_F(ReassemblyTest, RefusesDuplicatesBeforeAndAfterTheMessageIsComplete) {
  const Bytes payload = pattern(3 * kPiece, 1);
  const auto packets = fragments_of(9, "CAMERA", payload, kPiece);
  EXPECT_EQ(UdpmOutcome::kFragment, add(packets[1]).outcome);
  EXPECT_EQ(UdpmOutcome::kDuplicate, add(packets[1]).outcome);
  EXPECT_EQ(UdpmOutcome::kFragment, add(packets[0]).outcome);
  EXPECT_EQ(UdpmOutcome::kDuplicate, add(packets[0]).outcome);
  expect_complete(add(packets[2]), payload);
  for (const Bytes& packet : packets) EXPECT_EQ(UdpmOutcome::kDuplicate, add(packet).outcome);
  EXPECT_EQ(0, reassembly_.num_given_up());
}

TEST_F(ReassemblyTest, ADuplicateWithOtherBytesDoesNotChangeTheMessage) {
  const Bytes payload = pattern(2 * kPiece, 1);
  const auto packets = fragments_of(9, "CAMERA", payload, kPiece);
  const auto others = fragments_of(9, "CAMERA", pattern(2 * kPiece, 2), kPiece);
  (void)add(packets[0]);
  EXPECT_EQ(UdpmOutcome::kDuplicate, add(others[0]).outcome);
  expect_complete(add(packets[1]), payload);
}

TEST_F(ReassemblyTest, TellsSendersWithTheSameNumberApart) {
  const UdpmSource other_port{kSender.address, 40'001};
  const UdpmSource other_host{kSender.address + 1, kSender.port};
  const std::vector<UdpmSource> senders{kSender, other_port, other_host};
  std::vector<Bytes> payloads;
  for (std::uint32_t i = 0; i < 3; ++i) payloads.push_back(pattern(2 * kPiece, i));
  for (std::size_t i = 0; i < 3; ++i)
    (void)add(fragments_of(7, "CAMERA", payloads[i], kPiece)[0], senders[i]);
  for (std::size_t i = 0; i < 3; ++i)
    expect_complete(add(fragments_of(7, "CAMERA", payloads[i], kPiece)[1], senders[i]),
                    payloads[i]);
}

TEST_F(ReassemblyTest, GivesUpAMessageWhoseSizeOrCountChanges) {
  for (const bool changes_size : {true, false}) {
    const std::uint32_t sequence = changes_size ? 1 : 2;
    const auto packets = fragments_of(sequence, "CAMERA", pattern(3 * kPiece, 1), kPiece);
    (void)add(packets[0]);
    const test::FragmentFields fields{sequence, changes_size ? 3 * kPiece + 1 : 3 * kPiece, kPiece,
                                      1, changes_size ? 3U : 4U};
    EXPECT_EQ(UdpmOutcome::kInconsistent, add(fragment_packet(fields, Bytes(kPiece))).outcome);
    EXPECT_EQ(UdpmOutcome::kInconsistent, add(packets[1]).outcome) << "the message is done with";
    EXPECT_EQ(UdpmOutcome::kInconsistent, add(packets[2]).outcome);
  }
  EXPECT_EQ(2, reassembly_.num_given_up());
}

// Overlaps and holes have to meet somewhere: a seam that does not fit shows both.
TEST_F(ReassemblyTest, GivesUpFragmentsThatOverlapOrLeaveHoles) {
  std::uint32_t sequence = 10;
  for (const std::uint32_t begin : {kPiece - 1, kPiece + 1}) {
    for (const bool left_first : {true, false}) {
      ++sequence;
      const std::uint32_t size = 9 * kPiece / 2;
      const Bytes left = fragment_packet({sequence, size, begin, 1, 4}, Bytes(kPiece));
      const Bytes right = fragment_packet({sequence, size, 2 * kPiece, 2, 4}, Bytes(kPiece));
      EXPECT_EQ(UdpmOutcome::kFragment, add(left_first ? left : right).outcome);
      EXPECT_EQ(UdpmOutcome::kInconsistent, add(left_first ? right : left).outcome);
    }
  }
}

TEST_F(ReassemblyTest, RefusesMessagesAndCountsThatDoNotFit) {
  EXPECT_EQ(UdpmOutcome::kTooLarge,
            add(fragment_packet({1, kMaxBytes + 1, 5, 1, 3}, Bytes(10))).outcome);
  EXPECT_EQ(UdpmOutcome::kTooLarge,
            add(fragment_packet({1, kMaxBytes + 1, 15, 2, 4}, Bytes(10))).outcome)
      << "the message is done with";
  EXPECT_EQ(UdpmOutcome::kTooLarge,
            add(fragment_packet({2, 0xFFFFFFFF, 5, 1, 3}, Bytes(10))).outcome);
  const auto most = static_cast<std::uint32_t>(kMaxBytes / Reassembly::kMinFragmentBytes + 2);
  EXPECT_EQ(UdpmOutcome::kTooManyFragments,
            add(fragment_packet({3, kMaxBytes, 5, 1, most + 1}, Bytes(10))).outcome);
  EXPECT_EQ(UdpmOutcome::kFragment,
            add(fragment_packet({4, kMaxBytes, 5, most - 2, most}, Bytes(10))).outcome);
  EXPECT_EQ(0, reassembly_.num_given_up());
}

TEST_F(ReassemblyTest, TakesAMessageOfExactlyTheLargestSize) {
  const Bytes payload = pattern(kMaxBytes, 3);
  const auto packets = fragments_of(1, "CAMERA", payload, kPiece);
  for (std::size_t i = 0; i + 1 < packets.size(); ++i) (void)add(packets[i]);
  expect_complete(add(packets.back()), payload);
}

TEST_F(ReassemblyTest, GivesUpTheOldestOfTooManyOpenMessages) {
  std::vector<std::vector<Bytes>> messages;
  for (std::uint16_t i = 0; i < 4; ++i) {
    messages.push_back(fragments_of(1, "CAMERA", pattern(2 * kPiece, i), kPiece));
    (void)add(messages.back()[0], {1, i});
  }
  EXPECT_EQ(1, reassembly_.num_given_up());
  EXPECT_EQ(UdpmOutcome::kGivenUp, add(messages[0][1], {1, 0}).outcome);
  for (std::uint16_t i = 1; i < 4; ++i)
    expect_complete(add(messages[i][1], {1, i}), pattern(2 * kPiece, i));
}

TEST_F(ReassemblyTest, MessagesWithoutAChannelAreGivenUpFirstAndDisplaceNone) {
  const auto message = [](std::uint16_t i) {
    return fragments_of(1, "CAMERA", pattern(2 * kPiece, i), kPiece);
  };
  (void)add(message(0)[0], {1, 0});
  (void)add(message(1)[1], {1, 1});  // no channel yet
  (void)add(message(2)[0], {1, 2});
  (void)add(message(3)[0], {1, 3});
  EXPECT_EQ(UdpmOutcome::kGivenUp, add(message(1)[0], {1, 1}).outcome);
  EXPECT_EQ(1, reassembly_.num_given_up());
  EXPECT_EQ(UdpmOutcome::kNoRoom, add(message(4)[1], {1, 4}).outcome);
  expect_complete(add(message(0)[1], {1, 0}), pattern(2 * kPiece, 0));
  EXPECT_EQ(UdpmOutcome::kFragment, add(message(4)[1], {1, 4}).outcome) << "there is room now";
  EXPECT_EQ(1, reassembly_.num_given_up());
}

TEST_F(ReassemblyTest, ACompleteMessageGivesUpWhatItsSenderLeftOpenBefore) {
  const auto lost = fragments_of(0xFFFFFFFF, "CAMERA", pattern(2 * kPiece, 1), kPiece);
  const auto other = fragments_of(0xFFFFFFFF, "CAMERA", pattern(2 * kPiece, 2), kPiece);
  const auto newer = fragments_of(1, "CAMERA", pattern(2 * kPiece, 2), kPiece);
  (void)add(lost[0]);
  (void)add(other[0], {5, 5});
  (void)add(newer[0]);
  const auto whole = fragments_of(0, "CAMERA", pattern(2 * kPiece, 3), kPiece);  // numbers wrap
  (void)add(whole[0]);  // three are open: the oldest, `lost`, is given up
  EXPECT_EQ(1, reassembly_.num_given_up());
  (void)add(whole[1]);
  EXPECT_EQ(1, reassembly_.num_given_up()) << "neither another sender's nor a newer one";
  expect_complete(add(newer[1]), pattern(2 * kPiece, 2));
  (void)add(fragments_of(2, "CAMERA", pattern(2 * kPiece, 3), kPiece)[0]);
  const auto last = fragments_of(3, "CAMERA", pattern(2 * kPiece, 3), kPiece);
  (void)add(last[0]);
  (void)add(last[1]);
  EXPECT_EQ(2, reassembly_.num_given_up()) << "number 2 was left open";
}

TEST_F(ReassemblyTest, RefusingAMessageReleasesItAndNamesTheReasonForTheRest) {
  const auto packets = fragments_of(1, "CAMERA", pattern(3 * kPiece, 1), kPiece);
  (void)add(packets[1]);
  reassembly_.refuse(kSender, 1, UdpmOutcome::kUnsubscribed);
  EXPECT_EQ(UdpmOutcome::kUnsubscribed, add(packets[2]).outcome);
  EXPECT_EQ(0, reassembly_.num_given_up());
}

TEST_F(ReassemblyTest, RemembersAFixedNumberOfMessagesThatAreDoneWith) {
  for (std::uint32_t i = 0; i < Reassembly::kNumClosed + 1; ++i)
    reassembly_.refuse(kSender, i, UdpmOutcome::kUnsubscribed);
  EXPECT_EQ(UdpmOutcome::kFragment, reassembly_.closed_outcome(kSender, 0));
  EXPECT_EQ(UdpmOutcome::kUnsubscribed, reassembly_.closed_outcome(kSender, 1));
  EXPECT_EQ(UdpmOutcome::kUnsubscribed,
            reassembly_.closed_outcome(kSender, Reassembly::kNumClosed));
  EXPECT_EQ(UdpmOutcome::kFragment, reassembly_.closed_outcome({1, 1}, 1));
}

TEST_F(ReassemblyTest, GrowingGivesUpWhatIsOpen) {
  const auto packets = fragments_of(1, "CAMERA", pattern(2 * kPiece, 1), kPiece);
  (void)add(packets[0]);
  reassembly_.reserve(kMaxBytes);
  EXPECT_EQ(0, reassembly_.num_given_up()) << "it has that size already";
  reassembly_.reserve(kMaxBytes + 1);
  EXPECT_EQ(kMaxBytes + 1, reassembly_.max_message_bytes());
  EXPECT_EQ(1, reassembly_.num_given_up());
}

TEST(Reassembly, WithoutPlacesRefusesEveryMessage) {
  Reassembly none(0);
  none.reserve(kMaxBytes);
  UdpmPacket packet;
  const auto packets = fragments_of(1, "CAMERA", pattern(2 * kPiece, 1), kPiece);
  ASSERT_EQ(UdpmOutcome::kFragment, parse_udpm_packet(packets[0], &packet));
  EXPECT_EQ(UdpmOutcome::kNoRoom, none.add(kSender, packet, kChannelNumber).outcome);
}

}  // namespace
}  // namespace plumb
