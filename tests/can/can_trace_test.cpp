#include "platform/can_trace.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace plumb {
namespace {

class CanTrace : public ::testing::Test {
 protected:
  std::string path_ = (std::filesystem::temp_directory_path() /
                       ("plumb_can_trace_" + std::to_string(::getpid()) + ".can"))
                          .string();
  ~CanTrace() override { std::filesystem::remove(path_); }

  static CanFrame frame(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
    CanFrame f;
    f.id = id;
    for (const std::uint8_t byte : bytes) f.data[f.size++] = byte;
    return f;
  }
  std::string text() const {
    std::ostringstream out;
    out << std::ifstream(path_).rdbuf();
    return out.str();
  }
  void put(const std::string& content) const { std::ofstream(path_) << content; }
};

TEST_F(CanTrace, WritesWhatCandumpWrites) {
  CanTraceWriter writer(path_, "can0");
  writer.send(1'436'509'052'249'713, frame(0x123, {0xDE, 0xAD, 0xBE, 0xEF}));
  writer.send(7, frame(0x3A0, {}));
  CanFrame extended = frame(0x12345, {1});
  extended.extended = true;
  writer.send(1'000'000, extended);
  CanFrame fd = frame(0x3A1, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  fd.fd = true;
  writer.send(2'000'000, fd);
  ASSERT_TRUE(writer.flush());
  EXPECT_EQ(text(),
            "(1436509052.249713) can0 123#DEADBEEF\n"
            "(0000000000.000007) can0 3A0#\n"
            "(0000000001.000000) can0 00012345#01\n"
            "(0000000002.000000) can0 3A1##1000102030405060708090A0B\n");
  EXPECT_EQ(writer.num_frames(), 4);
}

TEST_F(CanTrace, TimeOffsetTurnsOneClockIntoAnother) {
  {
    CanTraceWriter writer(path_, "can0");
    writer.set_time_offset_us(1'000'000'000'000);
    writer.send(5, frame(0x1, {}));
  }
  EXPECT_EQ(text(), "(0001000000.000005) can0 001#\n");
}

TEST_F(CanTrace, ReadsBackWhatItWrote) {
  constexpr int kNumFrames = 5000;  // more than one buffer
  {
    CanTraceWriter writer(path_, "can0");
    for (int i = 0; i < kNumFrames; ++i) {
      CanFrame f = frame(static_cast<std::uint32_t>(i % 0x800), {});
      f.fd = i % 3 == 0;
      f.extended = i % 5 == 0;
      f.size = static_cast<std::uint8_t>(f.fd ? 64 : i % 9);
      for (std::size_t b = 0; b < f.size; ++b)
        f.data[b] = static_cast<std::uint8_t>(i + 37 * static_cast<int>(b));
      writer.send(i * 1'234'567LL, f);
    }
  }
  CanTraceReader reader(path_);
  std::int64_t time_us = 0;
  CanFrame f;
  for (int i = 0; i < kNumFrames; ++i) {
    ASSERT_TRUE(reader.next(&time_us, &f)) << reader.error();
    ASSERT_EQ(time_us, i * 1'234'567LL);
    ASSERT_EQ(f.id, static_cast<std::uint32_t>(i % 0x800));
    ASSERT_EQ(f.fd, i % 3 == 0);
    ASSERT_EQ(f.extended, i % 5 == 0);
    ASSERT_EQ(f.size, f.fd ? 64 : i % 9);
    for (std::size_t b = 0; b < f.size; ++b) {
      ASSERT_EQ(f.data[b], static_cast<std::uint8_t>(i + 37 * static_cast<int>(b)));
    }
  }
  EXPECT_FALSE(reader.next(&time_us, &f));
  EXPECT_EQ(reader.error(), "");
}

TEST_F(CanTrace, AFullDiskIsReportedOnceAndDoesNotThrow) {
  CanTraceWriter writer("/dev/full", "can0");
  ASSERT_EQ(writer.error(), "");
  writer.send(0, frame(0x3A0, {1}));
  EXPECT_FALSE(writer.flush());
  EXPECT_EQ(writer.error(), "/dev/full: cannot write: No space left on device");
  for (int i = 0; i < 10'000; ++i) writer.send(i, frame(0x3A0, {1}));
  EXPECT_EQ(writer.num_frames(), 1);
}

TEST_F(CanTrace, AFullDiskIsNoticedWithoutFlushing) {
  CanTraceWriter writer("/dev/full", "can0");
  for (int i = 0; i < 10'000; ++i) writer.send(i, frame(0x3A0, {1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_NE(writer.error(), "");
}

TEST_F(CanTrace, AFileThatCannotBeCreatedIsReported) {
  CanTraceWriter writer("/nonexistent/folder/x.can", "can0");
  EXPECT_EQ(writer.error(), "/nonexistent/folder/x.can: cannot create: No such file or directory");
  writer.send(0, frame(1, {}));
  EXPECT_FALSE(writer.flush());
}

TEST_F(CanTrace, AMissingFileIsReportedByTheReader) {
  CanTraceReader reader("/nonexistent.can");
  std::int64_t time_us = 0;
  CanFrame f;
  EXPECT_FALSE(reader.next(&time_us, &f));
  EXPECT_EQ(reader.error(), "/nonexistent.can: cannot read: No such file or directory");
}

TEST_F(CanTrace, ALineThatIsNoFrameIsNamed) {
  for (const char* bad : {
           "hello",
           "(1.000000) can0 123#0",
           "(1.000000) can0 123#0G",
           "(1.000000) can0 12#00",
           "(1.000000) can0 1X3#00",
           "(1.000000) can0 123",
           "(1.000000) can0 123##",
           "(1.000000)",
           "(1.000000) can0 123#00 extra",
           "(1.000000) can0 123#001122334455667788",
       }) {
    put(std::string("(1.000000) can0 123#00\n\n") + bad + "\n");
    CanTraceReader reader(path_);
    std::int64_t time_us = 0;
    CanFrame f;
    EXPECT_TRUE(reader.next(&time_us, &f));
    EXPECT_FALSE(reader.next(&time_us, &f)) << bad;
    EXPECT_EQ(reader.error(), path_ + ":3: not a CAN frame") << bad;
    EXPECT_FALSE(reader.next(&time_us, &f)) << "stays at the first bad line";
  }
}

}  // namespace
}  // namespace plumb
