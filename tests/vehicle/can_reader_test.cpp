// A socket pair stands in for the interface. The real one is tested in tests/can/vcan.
#include "platform/can_reader.hpp"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <sys/socket.h>
#include <unistd.h>

namespace plumb {
namespace {

int g_far_end = -1;
bool g_is_up = true;

int open_near_end(const std::string& /*interface*/, std::string* why) {
  if (!g_is_up) {
    *why = "no such interface";
    return -1;
  }
  int ends[2];
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends), 0);
  g_far_end = ends[1];
  return ends[0];
}

class CanReaderTest : public testing::Test {
 protected:
  CanReaderTest() { g_is_up = true; }
  ~CanReaderTest() override { hang_up(); }
  static void hang_up() {
    if (g_far_end >= 0) ::close(g_far_end);
    g_far_end = -1;
  }
  CanReader reader_{"can9", 0x123, false, &open_near_end};
};

TEST_F(CanReaderTest, ReadsClassicAndFdFrames) {
  CanFrame frame;
  EXPECT_FALSE(reader_.read(&frame)) << "not open yet";
  reader_.service(0);
  EXPECT_TRUE(reader_.is_up());
  EXPECT_FALSE(reader_.read(&frame)) << "nothing waits";
  can_frame classic{};
  classic.can_id = 0x123;
  classic.can_dlc = 2;
  classic.data[1] = 0xAB;
  ASSERT_EQ(::send(g_far_end, &classic, sizeof classic, 0), static_cast<ssize_t>(CAN_MTU));
  canfd_frame fd{};
  fd.can_id = 0x18FEF1FE | CAN_EFF_FLAG;
  fd.len = 64;
  fd.data[63] = 0xCD;
  ASSERT_EQ(::send(g_far_end, &fd, sizeof fd, 0), static_cast<ssize_t>(CANFD_MTU));
  ASSERT_TRUE(reader_.read(&frame));
  EXPECT_EQ(frame.id, 0x123U);
  EXPECT_EQ(frame.size, 2);
  EXPECT_EQ(frame.data[1], 0xAB);
  EXPECT_FALSE(frame.extended);
  EXPECT_FALSE(frame.fd);
  ASSERT_TRUE(reader_.read(&frame));
  EXPECT_EQ(frame.id, 0x18FEF1FEU);
  EXPECT_EQ(frame.size, 64);
  EXPECT_EQ(frame.data[63], 0xCD);
  EXPECT_TRUE(frame.extended);
  EXPECT_TRUE(frame.fd);
  EXPECT_FALSE(reader_.read(&frame));
}

TEST_F(CanReaderTest, PassesOverErrorFramesAndRequests) {
  reader_.service(0);
  can_frame frame{};
  frame.can_dlc = 8;
  for (const canid_t flags : {CAN_ERR_FLAG, CAN_RTR_FLAG, canid_t{0}}) {
    frame.can_id = 0x123 | flags;
    frame.data[0] = flags == 0 ? 0xAB : 0xEE;
    ASSERT_EQ(::send(g_far_end, &frame, sizeof frame, 0), static_cast<ssize_t>(CAN_MTU));
  }
  CanFrame got;
  ASSERT_TRUE(reader_.read(&got));
  EXPECT_EQ(got.data[0], 0xAB) << "the bits of an error are no speed";
  EXPECT_FALSE(reader_.read(&got));
}

TEST_F(CanReaderTest, TriesAnInterfaceThatIsDownAgainEverySecond) {
  CanFrame frame;
  reader_.service(0);
  hang_up();
  EXPECT_FALSE(reader_.read(&frame));
  EXPECT_FALSE(reader_.is_up());
  EXPECT_EQ(reader_.state(), "can9: Network is down");
  g_is_up = false;
  reader_.service(1'000'000);
  EXPECT_EQ(reader_.state(), "can9: no such interface");
  g_is_up = true;
  reader_.service(1'999'999);
  EXPECT_FALSE(reader_.is_up()) << "too early";
  reader_.service(2'000'000);
  EXPECT_TRUE(reader_.is_up());
  EXPECT_EQ(reader_.state(), "");
}

}  // namespace
}  // namespace plumb
