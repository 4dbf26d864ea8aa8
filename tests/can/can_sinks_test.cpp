// Tests what is said about the bus and the trace together.
#include "platform/can_sinks.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>

#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

int no_bus(const std::string& /*interface*/, std::string* why) {
  *why = "no such interface";
  return -1;
}

CanFrame any_frame() {
  CanFrame f;
  f.id = 0x3A0;
  f.size = 8;
  return f;
}

TEST(CanSinks, ABrokenTraceDoesNotHideWhatTheBusSays) {
  CanSinks sinks;
  ASSERT_EQ(sinks.open("can7", "/dev/full", 0, &no_bus), "");
  sinks.service(1'000'000);
  EXPECT_TRUE(sinks.trouble_changed());
  EXPECT_STREQ(sinks.trouble(), "can7: no such interface");
  sinks.send(0, any_frame());
  EXPECT_FALSE(sinks.close());
  sinks.service(1'010'000);
  EXPECT_TRUE(sinks.trouble_changed());
  EXPECT_STREQ(sinks.trouble(),
               "can7: no such interface; /dev/full: cannot write: No space left on device");
  EXPECT_FALSE(sinks.is_useless()) << "the bus may come";
  sinks.service(1'020'000);
  EXPECT_FALSE(sinks.trouble_changed());
  EXPECT_EQ(sinks.num_unsent(), 1) << "of the bus";
}

TEST(CanSinks, WithoutABusABrokenTraceIsTheEnd) {
  CanSinks sinks;
  ASSERT_EQ(sinks.open("", "/dev/full", 0, &no_bus), "");
  EXPECT_FALSE(sinks.is_useless());
  sinks.send(0, any_frame());
  (void)sinks.close();
  EXPECT_TRUE(sinks.is_useless());
}

TEST(CanSinks, SaysThatFramesAreMissingFromTheTraceAndThenNoMore) {
  const test::TempFolder folder;
  const std::string path = (folder / "pipe").string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const int reader = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  CanSinks sinks;
  ASSERT_EQ(sinks.open("", path, 0, &no_bus), "");
  std::int64_t now_us = 5'000'000;
  sinks.service(now_us);
  EXPECT_STREQ(sinks.trouble(), "");
  for (int i = 0; i < 100'000; ++i) sinks.send(now_us, any_frame());
  sinks.service(now_us);
  EXPECT_EQ(sinks.trouble(),
            path + ": too slow, " + std::to_string(sinks.num_dropped()) + " frames are missing");
  EXPECT_FALSE(sinks.is_useless());
  now_us += 1'000'001;
  sinks.service(now_us);
  EXPECT_STREQ(sinks.trouble(), "");
  ::close(reader);
}

}  // namespace
}  // namespace plumb
