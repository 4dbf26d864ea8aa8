// Tests that a trace never holds up who sends, and that it continues a file that exists.
#include "platform/can_trace_thread.hpp"

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

using Clock = std::chrono::steady_clock;

CanFrame trace_frame(std::uint8_t byte) {
  CanFrame f;
  f.id = 0x3A0;
  f.size = 8;
  f.data[0] = byte;
  return f;
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

TEST(CanTraceThread, ContinuesAFileThatExists) {
  const test::TempFolder folder;
  const std::string path = folder.write("t.can", "(0000000001.000000) can0 3A0#00\n").string();
  for (int run = 2; run <= 3; ++run) {
    CanTraceThread trace(path, "can0", 0);
    trace.send(run * 1'000'000, trace_frame(7));
    EXPECT_TRUE(trace.close());
    EXPECT_EQ(trace.num_frames(), 1);
  }
  EXPECT_EQ(test::read_text(path),
            "(0000000001.000000) can0 3A0#00\n"
            "(0000000002.000000) can0 3A0#0700000000000000\n"
            "(0000000003.000000) can0 3A0#0700000000000000\n");
}

TEST(CanTraceThread, EndsALineThatAPowerCutLeft) {
  const test::TempFolder folder;
  const std::string path = folder.write("t.can", "(0000000001.00").string();
  {
    CanTraceThread trace(path, "can0", 0);
    trace.send(0, trace_frame(7));
  }
  EXPECT_EQ(test::read_text(path),
            "(0000000001.00\n(0000000000.000000) can0 3A0#0700000000000000\n");
}

TEST(CanTraceThread, WritesEverythingInOrder) {
  const test::TempFolder folder;
  const std::string path = (folder / "t.can").string();
  constexpr int kNumFrames = 20'000;
  {
    CanTraceThread trace(path, "can0", 5);
    for (int i = 0; i < kNumFrames; ++i) {
      trace.send(i, trace_frame(static_cast<std::uint8_t>(i)));
      if (i % 1000 == 999) std::this_thread::sleep_for(std::chrono::milliseconds(60));
    }
    EXPECT_EQ(trace.num_dropped(), 0);
    EXPECT_TRUE(trace.close());
  }
  CanTraceReader reader(path);
  std::int64_t time_us = 0;
  CanFrame f;
  for (int i = 0; i < kNumFrames; ++i) {
    ASSERT_TRUE(reader.next(&time_us, &f));
    ASSERT_EQ(time_us, i + 5);
    ASSERT_EQ(f.data[0], static_cast<std::uint8_t>(i));
  }
  EXPECT_FALSE(reader.next(&time_us, &f));
}

TEST(CanTraceThread, APipeThatNobodyReadsDropsFramesAndHoldsNobodyUp) {
  const test::TempFolder folder;
  const std::string path = (folder / "pipe").string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const int reader = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  CanTraceThread trace(path, "can0", 0);
  ASSERT_EQ(trace.error(), "");
  const auto start = Clock::now();
  for (int i = 0; i < 200'000; ++i) trace.send(i, trace_frame(1));
  EXPECT_LT(seconds_since(start), 1.0);
  EXPECT_GT(trace.num_dropped(), 100'000);
  EXPECT_EQ(trace.num_frames() + trace.num_dropped(), 200'000);
  EXPECT_EQ(trace.error(), "") << "a slow reader is no failure";
  EXPECT_FALSE(trace.close()) << "not all of it was written";
  EXPECT_LT(seconds_since(start), 4.0);
  ::close(reader);
}

TEST(CanTraceThread, APipeWithoutAReaderIsRefusedAtOnce) {
  const test::TempFolder folder;
  const std::string path = (folder / "pipe").string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const CanTraceThread trace(path, "can0", 0);
  EXPECT_EQ(trace.error(), path + ": cannot create: No such device or address");
}

TEST(CanTraceThread, AFullDiskIsReported) {
  CanTraceThread trace("/dev/full", "can0", 0);
  EXPECT_EQ(trace.error(), "");
  trace.send(0, trace_frame(1));
  EXPECT_FALSE(trace.close());
  EXPECT_EQ(trace.error(), "/dev/full: cannot write: No space left on device");
  trace.send(1, trace_frame(1));
  EXPECT_EQ(trace.num_frames(), 1);
}

}  // namespace
}  // namespace plumb
