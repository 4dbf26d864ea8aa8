// Packets from another machine: a second network namespace at the other end of a virtual cable.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "platform/udpm/udpm_receiver.hpp"
#include "platform/udpm/udpm_sender.hpp"
#include "tests/platform/udpm/packets.hpp"
#include "tests/platform/udpm/stock_lcm.hpp"
#include "tests/support/other_machine.hpp"
#include "tests/support/private_network.hpp"

namespace plumb {
namespace {

using test::Bytes;
using test::OtherMachine;
using test::run;
using test::short_packet;
using test::wait_for_message;

constexpr const char* kNetwork = "udpm://239.255.76.67:7667?recv_buf_size=4000000";

bool send_to(const char* to, const char* from, std::uint8_t payload) {
  const FileDescriptor fd(::socket(AF_INET, SOCK_DGRAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  ::inet_pton(AF_INET, from, &address.sin_addr);
  if (::bind(fd.get(), reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) return false;
  address.sin_port = htons(7667);
  ::inet_pton(AF_INET, to, &address.sin_addr);
  const Bytes packet = short_packet(1, "CAMERA", {payload});
  return ::sendto(fd.get(), packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&address),
                  sizeof address) > 0;
}

/// Sends to the group, to our address, and to the group with our address and none as its source.
bool send_all() {
  return send_to("239.255.76.67", "10.7.0.2", 1) && send_to("10.7.0.1", "10.7.0.2", 2) &&
         run("ip addr add 10.7.0.1/32 dev lo && ip link set lo up") &&
         send_to("239.255.76.67", "10.7.0.1", 3) && run("ip addr del 10.7.0.1/32 dev lo") &&
         run("ip addr del 10.7.0.2/24 dev there && ip route replace 224.0.0.0/4 dev there") &&
         send_to("239.255.76.67", "0.0.0.0", 4);
}

class UdpmForeign : public testing::Test {
 protected:
  static void SetUpTestSuite() { is_private_ = test::enter_private_network(); }
  void SetUp() override {
    if (!is_private_) GTEST_SKIP() << test::kNoPrivateNetwork;
  }
  static inline bool is_private_ = false;
};

TEST_F(UdpmForeign, PacketsOfAnotherMachineAreRefusedUnlessItIsNamed) {
  OtherMachine other(send_all);
  if (!other.is_connected()) GTEST_SKIP() << "no second network namespace can be made here";
  UdpmReceiver local_only(parse_udpm_url(kNetwork));
  UdpmReceiver naming(parse_udpm_url(std::string(kNetwork) + "&source=10.7.0.2"));
  local_only.subscribe({"CAMERA", 100, 8});
  naming.subscribe({"CAMERA", 100, 8});
  ASSERT_TRUE(other.send());

  // The multicast packet alone: unicast and the forged sources do not reach the socket.
  const MessageQueues::View heard = wait_for_message(&naming);
  ASSERT_EQ(1U, heard.bytes.size());
  EXPECT_EQ(1, heard.bytes[0]);
  EXPECT_EQ(MessageQueues::kNone, wait_for_message(&naming, 200).subscription);
  EXPECT_EQ(1, naming.inbox().outcomes()[UdpmOutcome::kMessage]);

  EXPECT_EQ(MessageQueues::kNone, wait_for_message(&local_only, 200).subscription);
  EXPECT_EQ(1, local_only.inbox().outcomes()[UdpmOutcome::kForeignSource]);

  // What this machine sends on the same interface is heard.
  UdpmSender sender(parse_udpm_url(kNetwork));
  ASSERT_TRUE(sender.publish("CAMERA", Bytes{9}));
  const MessageQueues::View own = wait_for_message(&local_only);
  ASSERT_EQ(1U, own.bytes.size());
  EXPECT_EQ(9, own.bytes[0]);
  test::StockLcm stock(kNetwork);
  ASSERT_TRUE(stock.publish("CAMERA", {8}));
  EXPECT_NE(MessageQueues::kNone, wait_for_message(&local_only).subscription);
  EXPECT_EQ(1, local_only.inbox().outcomes().num_refused());
}

}  // namespace
}  // namespace plumb
