// A socket pair stands in for the interface: its peer reads what was sent, stops reading to fill
// the queue, writes error frames and disappears. The real interface is tested in vcan/.
#include "platform/socket_can.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <vector>

namespace plumb {
namespace {

int g_peer = -1;
int g_num_opens = 0;
bool g_is_present = true;

int open_pair(const std::string& /*interface*/, std::string* why) {
  ++g_num_opens;
  if (!g_is_present) {
    *why = "no such interface";
    return -1;
  }
  int ends[2];
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends), 0);
  const int small = 1;  // the kernel rounds it up to a few kilobytes
  EXPECT_EQ(::setsockopt(ends[0], SOL_SOCKET, SO_SNDBUF, &small, sizeof small), 0);
  g_peer = ends[1];
  return ends[0];
}

CanFrame frame(std::uint32_t id) {
  CanFrame f;
  f.id = id;
  f.size = 8;
  f.data[0] = 0xAB;
  return f;
}

class SocketCanTest : public ::testing::Test {
 protected:
  SocketCanTest() {
    g_is_present = true;
    g_num_opens = 0;
  }
  ~SocketCanTest() override { hang_up(); }

  static void hang_up() {
    if (g_peer >= 0) ::close(g_peer);
    g_peer = -1;
  }
  /// Identifiers of all frames that have reached the peer.
  static std::vector<std::uint32_t> received() {
    std::vector<std::uint32_t> ids;
    can_frame f{};
    while (::recv(g_peer, &f, sizeof f, MSG_DONTWAIT) > 0) ids.push_back(f.can_id);
    return ids;
  }
  static void bus_error(std::uint32_t kind, std::uint8_t controller = 0) {
    can_frame f{};
    f.can_id = CAN_ERR_FLAG | kind;
    f.can_dlc = CAN_ERR_DLC;
    f.data[1] = controller;
    ASSERT_EQ(::send(g_peer, &f, sizeof f, 0), static_cast<ssize_t>(sizeof f));
  }
  /// Sends until one frame has to wait; returns the number sent.
  int fill(std::int64_t now_us) {
    int count = 0;
    while (can_.counters().num_sent == count)
      can_.send(now_us, frame(static_cast<std::uint32_t>(count++)));
    return count - 1;
  }
  SocketCan can_{"can0", &open_pair};
};

TEST_F(SocketCanTest, SendsClassicAndFdFramesAsTheKernelWantsThem) {
  can_.service(0);
  EXPECT_TRUE(can_.is_up());
  EXPECT_EQ(can_.state(), "");
  CanFrame f = frame(0x3A0);
  can_.send(0, f);
  canfd_frame got{};
  ASSERT_EQ(::recv(g_peer, &got, sizeof got, 0), static_cast<ssize_t>(CAN_MTU));
  EXPECT_EQ(got.can_id, 0x3A0U);
  EXPECT_EQ(got.len, 8);
  EXPECT_EQ(got.data[0], 0xAB);

  f.fd = true;
  f.extended = true;
  f.size = 64;
  f.data[63] = 0x77;
  can_.send(0, f);
  ASSERT_EQ(::recv(g_peer, &got, sizeof got, 0), static_cast<ssize_t>(CANFD_MTU));
  EXPECT_EQ(got.can_id, 0x3A0U | CAN_EFF_FLAG);
  EXPECT_EQ(got.len, 64);
  EXPECT_EQ(got.flags & CANFD_BRS, CANFD_BRS);
  EXPECT_EQ(got.data[63], 0x77);
  EXPECT_EQ(can_.counters().num_sent, 2);
}

TEST_F(SocketCanTest, AFullQueueIsRetriedInOrder) {
  can_.service(0);
  const int sent = fill(0);
  for (int i = 1; i < 10; ++i) can_.send(0, frame(static_cast<std::uint32_t>(sent + i)));
  can_.service(10'000);
  EXPECT_EQ(can_.counters().num_sent, sent) << "still full";

  std::vector<std::uint32_t> ids = received();
  for (std::int64_t t = 20'000; t <= 40'000; t += 5'000) {
    can_.service(t);
    for (const std::uint32_t id : received()) ids.push_back(id);
  }
  ASSERT_EQ(ids.size(), static_cast<std::size_t>(sent + 10));
  for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(ids[i], i);
  EXPECT_EQ(can_.counters().num_retried, 10);
  EXPECT_EQ(can_.counters().num_unsent, 0);
}

TEST_F(SocketCanTest, FramesThatWaitTooLongAreGivenUpAndCounted) {
  can_.service(0);
  fill(0);
  can_.send(0, frame(0x700));
  received();
  can_.service(SocketCan::kMaxPendingUs + 1);
  EXPECT_TRUE(received().empty()) << "old values do not reach the bus late";
  EXPECT_EQ(can_.counters().num_unsent, 2);
}

TEST_F(SocketCanTest, TheWaitingQueueIsBoundedAndDropsTheOldest) {
  can_.service(0);
  const int sent = fill(0);
  const int more = static_cast<int>(SocketCan::kMaxPending) + 5;
  for (int i = 1; i < more; ++i) can_.send(0, frame(static_cast<std::uint32_t>(sent + i)));
  EXPECT_EQ(can_.counters().num_unsent, 5);
  received();
  can_.service(1);
  const std::vector<std::uint32_t> ids = received();
  ASSERT_FALSE(ids.empty());
  EXPECT_EQ(ids.front(), static_cast<std::uint32_t>(sent + 5));
}

TEST_F(SocketCanTest, AnAbsentInterfaceIsNamedAndTriedEverySecond) {
  g_is_present = false;
  can_.service(0);
  EXPECT_FALSE(can_.is_up());
  EXPECT_EQ(can_.state(), "can0: no such interface");
  for (std::int64_t t = 0; t < 1'000'000; t += 10'000) {
    can_.service(t);
    can_.send(t, frame(1));
  }
  EXPECT_EQ(g_num_opens, 1);
  EXPECT_EQ(can_.counters().num_unsent, 100);

  g_is_present = true;
  can_.service(1'000'000);
  EXPECT_TRUE(can_.is_up());
  EXPECT_EQ(can_.state(), "");
  can_.send(1'000'000, frame(0x42));
  EXPECT_EQ(received(), std::vector<std::uint32_t>{0x42}) << "nothing of the time before";
}

TEST_F(SocketCanTest, AnInterfaceThatDisappearsIsNoticedAndComesBack) {
  can_.service(0);
  hang_up();
  g_is_present = false;
  can_.service(10'000);
  EXPECT_FALSE(can_.is_up());
  EXPECT_NE(can_.state(), "");
  g_is_present = true;
  can_.service(1'000'000);
  EXPECT_TRUE(can_.is_up());
  EXPECT_EQ(can_.counters().num_opened, 2);
}

TEST_F(SocketCanTest, AnInterfaceThatDisappearsWhileSendingLosesOnlyCountedFrames) {
  can_.service(0);
  fill(0);
  can_.send(0, frame(0x700));
  hang_up();
  can_.send(0, frame(0x701));
  can_.service(10'000);
  EXPECT_FALSE(can_.is_up());
  EXPECT_EQ(can_.counters().num_unsent, 3);
  can_.send(10'000, frame(0x702));
  EXPECT_EQ(can_.counters().num_unsent, 4);
}

TEST_F(SocketCanTest, ASendThatFailsTakesTheInterfaceDown) {
  can_.service(0);
  hang_up();
  can_.send(0, frame(0x701));
  EXPECT_FALSE(can_.is_up());
  EXPECT_EQ(can_.counters().num_unsent, 1);
}

TEST_F(SocketCanTest, ErrorFramesAreCountedAndTold) {
  can_.service(0);
  bus_error(CAN_ERR_ACK);
  bus_error(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE);
  can_.service(1);
  EXPECT_EQ(can_.counters().num_errors, 2);
  EXPECT_EQ(can_.counters().num_unacked, 1);
  EXPECT_EQ(can_.counters().num_passive, 1);
  EXPECT_EQ(can_.state(), "can0: the controller reports too many errors on the bus");

  bus_error(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE);
  can_.service(2);
  EXPECT_EQ(can_.state(), "");

  bus_error(CAN_ERR_BUSOFF);
  can_.service(3);
  EXPECT_EQ(can_.counters().num_bus_off, 1);
  EXPECT_EQ(can_.state(), "can0: bus-off; it stays so unless restart-ms is set");
  bus_error(CAN_ERR_RESTARTED);
  can_.service(4);
  EXPECT_EQ(can_.state(), "");
}

TEST_F(SocketCanTest, OrdinaryFramesFromTheBusAreNoErrors) {
  can_.service(0);
  can_frame f{};
  f.can_id = 0x123;
  ASSERT_EQ(::send(g_peer, &f, sizeof f, 0), static_cast<ssize_t>(sizeof f));
  can_.service(1);
  EXPECT_EQ(can_.counters().num_errors, 0);
}

TEST(SocketCanKernel, AnInterfaceThatIsNotThereIsRefusedInWords) {
  for (const char* name : {"nosuchcan7", "", "an-interface-name-that-is-too-long"}) {
    std::string why;
    EXPECT_EQ(SocketCan::open_raw(name, &why), -1);
    EXPECT_NE(why, "") << name;
  }
}

/// Opens a socket that reads the frames 0x123 of a real interface, which others may use as well.
/// CAN FD is included.
int open_reader(const std::string& interface) {
  const int fd = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  const int on = 1;
  EXPECT_EQ(::setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on), 0);
  const can_filter filter{0x123, CAN_SFF_MASK};
  EXPECT_EQ(::setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, &filter, sizeof filter), 0);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
  EXPECT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  return fd;
}

TEST(SocketCanKernel, ClassicAndFdFramesCrossARealInterface) {
  const char* interface = std::getenv("PLUMB_CAN_INTERFACE");
  if (interface == nullptr)
    GTEST_SKIP() << "PLUMB_CAN_INTERFACE names no interface; vcan/run has one";
  const int reader = open_reader(interface);
  SocketCan can(interface);
  can.service(0);
  ASSERT_TRUE(can.is_up()) << can.state();
  CanFrame f = frame(0x123);
  can.send(0, f);
  f.fd = true;
  f.size = 64;
  f.data[63] = 0x5A;
  can.send(0, f);
  EXPECT_EQ(can.counters().num_sent, 2);

  canfd_frame got{};
  ASSERT_EQ(::recv(reader, &got, sizeof got, 0), static_cast<ssize_t>(CAN_MTU));
  EXPECT_EQ(got.can_id, 0x123U);
  EXPECT_EQ(got.len, 8);
  ASSERT_EQ(::recv(reader, &got, sizeof got, 0), static_cast<ssize_t>(CANFD_MTU));
  EXPECT_EQ(got.len, 64);
  EXPECT_EQ(got.data[63], 0x5A);
  can.service(1);
  EXPECT_TRUE(can.is_up()) << "its own frames do not come back as errors";
  EXPECT_EQ(can.counters().num_errors, 0);
  ::close(reader);
}

}  // namespace
}  // namespace plumb
