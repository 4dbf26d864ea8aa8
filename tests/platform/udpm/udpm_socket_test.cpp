// What our endpoint takes from the kernel and gives to it.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>

#include "platform/udpm/local_addresses.hpp"
#include "platform/udpm/udpm_receiver.hpp"
#include "platform/udpm/udpm_sender.hpp"
#include "tests/platform/udpm/packets.hpp"
#include "tests/platform/udpm/stock_lcm.hpp"
#include "tests/support/count_malloc.hpp"
#include "tests/support/private_network.hpp"

namespace {
int g_failing_option = -1;  // of SOL_SOCKET
}

// The library's calls come here, so that a test can make one fail.
extern "C" int setsockopt(int fd, int level, int option, const void* value,
                          socklen_t bytes) noexcept {
  if (level == SOL_SOCKET && option == g_failing_option) {
    errno = ENOPROTOOPT;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_setsockopt, fd, level, option, value, bytes));
}

namespace plumb {
namespace {

using test::Bytes;
using test::is_readable;
using test::kTestUrl;
using test::pattern;
using test::short_packet;
using test::wait_for_message;

constexpr std::size_t kImageBytes = 466'616;

class UdpmSocket : public testing::Test {
 protected:
  static void SetUpTestSuite() { is_private_ = test::enter_private_network(); }
  void SetUp() override {
    if (!is_private_) GTEST_SKIP() << test::kNoPrivateNetwork;
  }
  static inline bool is_private_ = false;
};

void send_datagram(const Bytes& packet, const char* address, int port = 7667) {
  const FileDescriptor fd(::socket(AF_INET, SOCK_DGRAM, 0));
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  ::inet_pton(AF_INET, address, &to.sin_addr);
  ASSERT_EQ(static_cast<ssize_t>(packet.size()),
            ::sendto(fd.get(), packet.data(), packet.size(), 0,
                     reinterpret_cast<const sockaddr*>(&to), sizeof to));
}

TEST_F(UdpmSocket, TakesNoUnicastAndNoOtherPort) {
  UdpmReceiver receiver(parse_udpm_url(kTestUrl));
  receiver.subscribe({"CAMERA", 100, 4});
  send_datagram(short_packet(1, "CAMERA", {1}), "127.0.0.1");
  send_datagram(short_packet(1, "CAMERA", {2}), "239.255.76.68");
  send_datagram(short_packet(1, "CAMERA", {3}), "239.255.76.67", 7668);
  send_datagram(short_packet(1, "CAMERA", {4}), "239.255.76.67");
  const MessageQueues::View message = wait_for_message(&receiver);
  ASSERT_EQ(1U, message.bytes.size());
  EXPECT_EQ(4, message.bytes[0]);
  EXPECT_EQ(MessageQueues::kNone, wait_for_message(&receiver, 100).subscription);
  EXPECT_EQ(1, receiver.inbox().outcomes()[UdpmOutcome::kMessage]);
  EXPECT_EQ(0, receiver.inbox().outcomes().num_refused());
}

TEST_F(UdpmSocket, IsReadableExactlyWhileAMessageMayBeTaken) {
  UdpmReceiver receiver(parse_udpm_url(kTestUrl));
  UdpmSender sender(parse_udpm_url(kTestUrl));
  const int motion = receiver.subscribe({"VO_MOTION", 100, 4});
  EXPECT_FALSE(is_readable(receiver.fileno(), 0));
  for (std::uint8_t i = 0; i < 3; ++i) ASSERT_TRUE(sender.publish("VO_MOTION", Bytes{i}));
  for (std::uint8_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(is_readable(receiver.fileno(), 1'000)) << "the socket was emptied by the first";
    const MessageQueues::View message = receiver.take();
    ASSERT_EQ(motion, message.subscription);
    EXPECT_EQ(i, message.bytes[0]);
  }
  EXPECT_FALSE(is_readable(receiver.fileno(), 0));
  for (std::uint8_t i = 0; i < 3; ++i) ASSERT_TRUE(sender.publish("VO_MOTION", Bytes{i}));
  EXPECT_EQ(motion, receiver.take().subscription);
  receiver.unsubscribe(motion);
  EXPECT_FALSE(is_readable(receiver.fileno(), 0));
}

TEST_F(UdpmSocket, LeavesMessagesInTheKernelWhenTheSlotsAreTaken) {
  UdpmReceiver receiver(parse_udpm_url(kTestUrl));
  UdpmSender sender(parse_udpm_url(kTestUrl));
  receiver.subscribe({"VO_MOTION", 100, 2});
  for (std::uint8_t i = 0; i < 100; ++i) ASSERT_TRUE(sender.publish("VO_MOTION", Bytes{i}));
  for (std::uint8_t i = 0; i < 100; ++i) {
    const MessageQueues::View message = wait_for_message(&receiver);
    ASSERT_EQ(1U, message.bytes.size());
    ASSERT_EQ(i, message.bytes[0]);
  }
}

TEST_F(UdpmSocket, GivesTheNewestImageToAReaderThatIsBehindAndCountsTheOthers) {
  UdpmReceiver receiver(parse_udpm_url(kTestUrl));
  UdpmSender sender(parse_udpm_url(kTestUrl));
  const int image = receiver.subscribe({"CAMERA", kImageBytes, 2, Delivery::kLatest});
  const int motion = receiver.subscribe({"VO_MOTION", 100, 8});
  for (std::uint32_t i = 0; i < 5; ++i) {
    ASSERT_TRUE(sender.publish("CAMERA", pattern(kImageBytes, i)));
    ASSERT_TRUE(sender.publish("VO_MOTION", Bytes{static_cast<std::uint8_t>(i)}));
  }
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(motion, receiver.take().subscription);
  const MessageQueues::View newest = receiver.take();
  ASSERT_EQ(image, newest.subscription);
  EXPECT_EQ(pattern(kImageBytes, 4), Bytes(newest.bytes.begin(), newest.bytes.end()));
  EXPECT_EQ(4, receiver.inbox().num_skipped(image));
  EXPECT_EQ(motion, receiver.take().subscription);
}

TEST_F(UdpmSocket, KnowsWhenAMessageArrived) {
  UdpmReceiver receiver(parse_udpm_url(kTestUrl));
  UdpmSender sender(parse_udpm_url(kTestUrl));
  receiver.subscribe({"VO_MOTION", 100, 4});
  ::usleep(100'000);  // the kernel begins to stamp packets a little after it was asked to
  const std::int64_t before_us = monotonic_us();
  ASSERT_TRUE(sender.publish("VO_MOTION", Bytes{1}));
  const std::int64_t after_us = monotonic_us();
  ::usleep(50'000);  // it waits in the kernel meanwhile
  const MessageQueues::View message = wait_for_message(&receiver);
  EXPECT_GE(message.arrival_us, before_us - 1'000);
  EXPECT_LE(message.arrival_us, after_us + 5'000);
}

TEST(ArrivalTime, LiesBetweenTheEmptySocketAndNowWhateverTheCalendarDoes) {
  constexpr std::int64_t kHour_us = 3'600'000'000;
  ArrivalTime arrival(1'000);
  EXPECT_EQ(1'500, arrival.of(70'500, 2'000, 71'000));
  EXPECT_EQ(1'000, arrival.of(70'500, 2'000, 71'000 + kHour_us)) << "the calendar went forward";
  EXPECT_EQ(2'000, arrival.of(70'500, 2'000, 71'000 - kHour_us)) << "the calendar went back";
  arrival.note_empty(5'000);
  EXPECT_EQ(3'005'000, arrival.of(72'000, 6'005'000, 3'072'000)) << "the process was stopped";
  EXPECT_EQ(5'000, arrival.of(70'000, 6'000, 71'500)) << "nothing waited at 5'000";
}

TEST_F(UdpmSocket, TellsHowManyMessagesOfAChannelWait) {
  UdpmReceiver receiver(parse_udpm_url(kTestUrl));
  UdpmSender sender(parse_udpm_url(kTestUrl));
  const int image = receiver.subscribe({"CAMERA", kImageBytes, 3});
  const int motion = receiver.subscribe({"VO_MOTION", 100, 8});
  for (std::uint32_t i = 0; i < 2; ++i)
    ASSERT_TRUE(sender.publish("CAMERA", pattern(kImageBytes, i)));
  ASSERT_EQ(image, receiver.take().subscription);
  EXPECT_EQ(1U, receiver.inbox().num_waiting(image)) << "the one being handled does not count";
  EXPECT_EQ(0U, receiver.inbox().num_waiting(motion));
  ASSERT_EQ(image, receiver.take().subscription);
  EXPECT_EQ(0U, receiver.inbox().num_waiting(image));
}

TEST_F(UdpmSocket, CountsWhatTheKernelDropped) {
  UdpmReceiver receiver(parse_udpm_url("udpm://239.255.76.67:7667?recv_buf_size=20000"));
  EXPECT_EQ(20'000, receiver.receive_buffer_bytes());
  UdpmSender sender(parse_udpm_url(kTestUrl));
  receiver.subscribe({"VO_MOTION", 1'000, 4});
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(sender.publish("VO_MOTION", Bytes(1'000)));
  std::int64_t num_taken = 0;
  while (receiver.take().subscription != MessageQueues::kNone) ++num_taken;
  EXPECT_LT(num_taken, 100);
  EXPECT_GT(num_taken, 4);
  ASSERT_TRUE(sender.publish("VO_MOTION", Bytes(1'000)));  // it brings the count
  EXPECT_NE(MessageQueues::kNone, wait_for_message(&receiver).subscription);
  EXPECT_EQ(200 - num_taken, receiver.num_overflowed());
}

TEST_F(UdpmSocket, AllocatesNothingAfterItsSubscriptions) {
  if (!test::kCountsMallocs) GTEST_SKIP() << "the sanitizer owns malloc";
  UdpmReceiver receiver(parse_udpm_url(kTestUrl));
  UdpmSender sender(parse_udpm_url(kTestUrl));
  receiver.subscribe({"CAMERA", kImageBytes, 2, Delivery::kLatest});
  receiver.subscribe({"VO_MOTION", 500, 8});
  const Bytes image = pattern(kImageBytes, 1);
  const Bytes motion = pattern(500, 2);
  int num_received = 0;
  const std::int64_t before = test::g_num_mallocs;
  for (int i = 0; i < 1'000; ++i) {
    sender.publish(i % 4 == 0 ? "CAMERA" : "VO_MOTION", i % 4 == 0 ? image : motion);
    sender.publish("UNREAD", i % 3 == 0 ? image : motion);
    if (wait_for_message(&receiver).subscription != MessageQueues::kNone) ++num_received;
  }
  EXPECT_EQ(0, test::g_num_mallocs - before);
  EXPECT_EQ(1'000, num_received);
}

TEST_F(UdpmSocket, SaysWhyItCannotJoin) {
  const UdpmUrl unreachable = parse_udpm_url("udpm://239.9.9.9:7667");
  UdpmSender sender(unreachable);
  ASSERT_EQ(0, std::system("ip route add unreachable 239.9.9.9/32"));
  EXPECT_THROW(UdpmReceiver receiver(unreachable), UdpmError);
  try {
    UdpmSender later(unreachable);
    FAIL() << "there is no route";
  } catch (const UdpmError& error) {
    EXPECT_EQ(0U, std::string(error.what()).find("cannot use LCM network udpm://239.9.9.9:7667: "))
        << error.what();
  }
  EXPECT_FALSE(sender.publish("VO_MOTION", Bytes{1}));
  EXPECT_FALSE(sender.publish("CAMERA", Bytes(kImageBytes)));
  EXPECT_EQ(2, sender.num_failed());
  EXPECT_EQ(0, sender.num_congested());

  const FileDescriptor greedy(::socket(AF_INET, SOCK_DGRAM, 0));
  sockaddr_in any{};
  any.sin_family = AF_INET;
  any.sin_port = htons(7777);
  ASSERT_EQ(0, ::bind(greedy.get(), reinterpret_cast<const sockaddr*>(&any), sizeof any));
  try {
    UdpmReceiver receiver(parse_udpm_url("udpm://239.255.76.67:7777"));
    FAIL() << "the port is taken";
  } catch (const UdpmError& error) {
    EXPECT_STREQ("cannot receive on UDP port 7777: Address already in use", error.what());
  }
}

TEST_F(UdpmSocket, SaysWhichOptionTheKernelRefuses) {
  g_failing_option = SO_RXQ_OVFL;
  try {
    UdpmReceiver receiver(parse_udpm_url(kTestUrl));
    FAIL() << "an option was refused";
  } catch (const UdpmError& error) {
    EXPECT_STREQ("cannot set SO_RXQ_OVFL: Protocol not available", error.what());
  }
  g_failing_option = -1;
}

TEST_F(UdpmSocket, ThrowsWhenThereAreNoDescriptorsLeft) {
  rlimit before{};
  ASSERT_EQ(0, ::getrlimit(RLIMIT_NOFILE, &before));
  const int next = ::dup(0);
  ::close(next);
  const auto construct_with = [&](int num_free) {
    const rlimit few{static_cast<rlim_t>(next + num_free), before.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &few);
    try {
      const UdpmReceiver receiver(parse_udpm_url(kTestUrl));
      return true;
    } catch (const std::runtime_error&) {
      return false;
    }
  };
  for (int num_free = 0; num_free < 3; ++num_free) EXPECT_FALSE(construct_with(num_free));
  EXPECT_TRUE(construct_with(3)) << "failures leave no descriptor behind";
  const rlimit none{static_cast<rlim_t>(next), before.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &none);
  EXPECT_THROW(UdpmSender sender(parse_udpm_url(kTestUrl)), UdpmError);
  EXPECT_FALSE(LocalAddresses().contains(0x0A000001, 0));
  ::setrlimit(RLIMIT_NOFILE, &before);
}

TEST_F(UdpmSocket, GetsAReceiveBufferBeyondTheLimitWhereItMay) {
  UdpmReceiver receiver(parse_udpm_url("udpm://?recv_buf_size=67108864"));
  EXPECT_EQ(67'108'864, receiver.receive_buffer_bytes());
}

TEST_F(UdpmSocket, RefusesToSendMoreThanFragmentsCanNumber) {
  UdpmSender sender(parse_udpm_url(kTestUrl));
  const std::uint8_t byte = 0;
  const std::size_t too_much = 65'535 * kUdpmMaxFragmentBody;  // never read
  EXPECT_FALSE(sender.publish("CAMERA", {&byte, too_much}));
  EXPECT_EQ(1, sender.num_failed());
}

/// A network interface that sends at a crawl.
TEST_F(UdpmSocket, CountsMessagesThatTheNetworkDoesNotTakeAsCongested) {
  if (std::system("ip link add slow type veth peer name slow_peer && "
                  "ip addr add 10.7.0.1/24 dev slow && ip link set slow_peer up && "
                  "ip link set slow up && ip route add 239.8.8.8/32 dev slow && "
                  "tc qdisc add dev slow root tbf rate 8kbit burst 2000 limit 1000000000") != 0)
    GTEST_SKIP() << "no slow network interface can be made here";
  UdpmSender sender(parse_udpm_url("udpm://239.8.8.8:7667?ttl=1"));
  const Bytes image = pattern(kImageBytes, 1);
  int num_sent = 0;
  std::int64_t took_us = 0;
  for (bool sent = true; sent && num_sent < 200; num_sent += sent ? 1 : 0) {
    const std::int64_t before_us = monotonic_us();
    sent = sender.publish("CAMERA", image);
    took_us = monotonic_us() - before_us;
  }
  EXPECT_LT(num_sent, 200);
  EXPECT_EQ(1, sender.num_congested());
  EXPECT_GE(took_us, (UdpmSender::kMaxWait_ms - 1) * 1'000);
  EXPECT_LT(took_us, 500'000);
  while (sender.publish("VO_MOTION", Bytes(1'000))) {
  }
  EXPECT_EQ(2, sender.num_congested());
  EXPECT_EQ(0, sender.num_failed());
}

TEST(LocalAddresses, AlwaysKnowsTheLoopbackNetwork) {
  LocalAddresses local;
  EXPECT_TRUE(local.contains(0x7F000001, 0));
  EXPECT_TRUE(local.contains(0x7FFFFFFE, 0));
  EXPECT_TRUE(local.contains(0, 0)) << "multicast on the loopback interface";
  EXPECT_FALSE(local.contains(0x80000001, 0));
}

TEST_F(UdpmSocket, LooksForNewAddressesOnceASecondAndForgetsOldOnesAfterAMinute) {
  constexpr std::uint32_t kAddress = 0x0A080001;  // 10.8.0.1
  constexpr std::int64_t kSecond_us = 1'000'000;
  LocalAddresses local;
  EXPECT_FALSE(local.contains(kAddress, 0));
  ASSERT_EQ(0, std::system("ip addr add 10.8.0.1/32 dev lo"));
  EXPECT_FALSE(local.contains(kAddress, kSecond_us - 1));
  EXPECT_TRUE(local.contains(kAddress, kSecond_us));
  ASSERT_EQ(0, std::system("ip addr del 10.8.0.1/32 dev lo"));
  EXPECT_TRUE(local.contains(kAddress, 61 * kSecond_us - 1));
  EXPECT_FALSE(local.contains(kAddress, 61 * kSecond_us));
}

}  // namespace
}  // namespace plumb
