// A fuzz target that hands datagrams of any content, from several senders, to the inbox of an
// endpoint.
//
// The input is a list of orders. An order either hands on raw bytes as a datagram, or describes a
// fragment in few bytes, so that mutations reach the rules of reassembly without guessing headers.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "platform/udpm/udpm_inbox.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace plumb {
namespace {

constexpr std::size_t kMaxSmall = 64;
constexpr std::size_t kMaxLarge = 8'192;

using fuzz::Orders;
using fuzz::require;

class Fuzzed {
 public:
  void run(Orders orders) {
    while (!orders.is_empty()) {
      const std::uint8_t order = orders.byte();
      const UdpmSource source{0x7F000001, static_cast<std::uint16_t>(order & 3U)};
      if ((order & 4U) != 0) {
        take(source, orders.bytes(orders.byte()));
      } else {
        take_fragment(source, &orders);
      }
      if ((order & 8U) != 0) read_one();
      while (inbox_.is_full()) read_one();
    }
    while (read_one()) {
    }
    check_counts();
  }

 private:
  void take_fragment(const UdpmSource& source, Orders* orders) {
    constexpr std::uint32_t kUnit = 256;  // sizes come in units, so that pieces often fit
    const std::uint8_t shape = orders->byte();
    UdpmPacket packet;
    packet.sequence = shape & 3U;
    packet.count = static_cast<std::uint16_t>(shape >> 2U & 7U);
    packet.number = orders->byte() & 7U;
    packet.message_bytes = packet.count * kUnit;
    packet.offset = packet.number * kUnit;
    const std::uint8_t change = orders->byte();
    if (change == 1) packet.offset = 0xFFFFFFFFU - orders->byte();
    if (change == 2) packet.message_bytes += orders->byte();
    if (change == 3) packet.message_bytes = 0xFFFFFF00U;
    if (change == 4) packet.offset ^= orders->byte();
    const std::size_t size = change == 5 ? orders->byte() : kUnit;
    const auto header = udpm_fragment_header(packet);
    std::array<std::uint8_t, kUdpmFragmentHeader + 2 + kUnit> datagram{};
    auto* end = std::copy(header.begin(), header.end(), datagram.begin());
    if (packet.number == 0) {
      *end++ = (shape & 0x80U) != 0 ? 'S' : 'L';
      *end++ = 0;
    }
    end = std::fill_n(end, size, packet.number);
    take(source, {datagram.begin(), end});
  }

  void take(const UdpmSource& source, std::span<const std::uint8_t> bytes) {
    const fuzz::TightCopy copy(bytes);
    ++num_packets_;
    const UdpmOutcome outcome = inbox_.take_packet(source, copy.bytes(), ++clock_us_);
    require(describe(outcome) != nullptr);
  }

  bool read_one() {
    const MessageQueues::View message = inbox_.pop();
    if (message.subscription == MessageQueues::kNone) return false;
    require(message.bytes.size() <= (message.subscription == small_ ? kMaxSmall : kMaxLarge));
    require(message.arrival_us > 0 && message.arrival_us <= clock_us_);
    std::uint64_t sum = checksum_;
    for (const std::uint8_t byte : message.bytes) sum += byte;
    checksum_ = sum;
    ++num_read_;
    inbox_.release();
    return true;
  }

  void check_counts() const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < kNumUdpmOutcomes; ++i)
      sum += inbox_.outcomes()[static_cast<UdpmOutcome>(i)];
    require(sum == num_packets_);
    const std::int64_t num_skipped =
        inbox_.num_skipped(small_) + inbox_.num_skipped(latest_) + inbox_.num_skipped(large_);
    require(num_read_ + num_skipped == inbox_.outcomes()[UdpmOutcome::kMessage]);
  }

  UdpmInbox inbox_{3};
  int small_ = inbox_.subscribe({"S", kMaxSmall, 4});
  int large_ = inbox_.subscribe({"L", kMaxLarge, 3});
  int latest_ = inbox_.subscribe({"N", kMaxLarge, 2, Delivery::kLatest});
  std::int64_t num_packets_ = 0;
  std::int64_t num_read_ = 0;
  std::int64_t clock_us_ = 0;
  volatile std::uint64_t checksum_ = 0;  // the bytes have to be read
};

}  // namespace
}  // namespace plumb

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plumb::Fuzzed().run(plumb::fuzz::Orders({data, size}));
  return 0;
}
