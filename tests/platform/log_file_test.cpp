#include "platform/log_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <numeric>

#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using Bytes = std::vector<std::uint8_t>;

// A log of four events. The third one is long, so that its end is far from its beginning.
constexpr std::size_t kDataBytes[] = {3, 0, 100'000, 8};
constexpr std::int64_t kHeader = 28;

void write_sample(const std::string& path) {
  LogWriter log(path);
  for (std::size_t i = 0; i < 4; ++i) {
    Bytes data(kDataBytes[i]);
    std::iota(data.begin(), data.end(), static_cast<std::uint8_t>(i));
    log.write(1000 + static_cast<std::int64_t>(i), i % 2 == 0 ? "CAMERA" : "VO_MOTION", data);
  }
  log.close();
}

// The offset of event `i` in the sample.
std::int64_t offset_of(std::size_t i) {
  std::int64_t offset = 0;
  for (std::size_t k = 0; k < i; ++k)
    offset += kHeader + (k % 2 == 0 ? 6 : 9) + static_cast<std::int64_t>(kDataBytes[k]);
  return offset;
}

struct Contents {
  std::vector<std::int64_t> times;
  std::vector<std::string> problems;  ///< without the name of the file
};

Contents read_all(const std::string& path) {
  Contents contents;
  LogReader reader(path);
  LogEvent event;
  while (reader.next(&event)) {
    contents.times.push_back(event.log_us);
    EXPECT_EQ(kDataBytes[event.log_us - 1000], event.data.size());
  }
  for (const std::string& problem : reader.problems()) {
    EXPECT_EQ(0U, problem.find(path + ": ")) << problem;
    contents.problems.push_back(problem.substr(path.size() + 2));
  }
  return contents;
}

Contents read_damaged(const std::function<void(std::string*)>& damage) {
  const test::TempFile file(".lcm");
  write_sample(file.path());
  std::string bytes = file.read();
  damage(&bytes);
  file.write(bytes);
  return read_all(file.path());
}

using Times = std::vector<std::int64_t>;
using Problems = std::vector<std::string>;

TEST(LogFile, ReadsWhatItWrote) {
  const test::TempFile file(".lcm");
  write_sample(file.path());
  LogReader reader(file.path());
  LogEvent event;
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(reader.next(&event));
    EXPECT_EQ(static_cast<std::int64_t>(i), event.number);
    EXPECT_EQ(i % 2 == 0 ? "CAMERA" : "VO_MOTION", event.channel);
    ASSERT_EQ(kDataBytes[i], event.data.size());
    for (std::size_t k = 0; k < event.data.size(); ++k)
      ASSERT_EQ(static_cast<std::uint8_t>(i + k), event.data[k]);
  }
  EXPECT_FALSE(reader.next(&event));
  EXPECT_FALSE(reader.next(&event)) << "a second read at the end also fails";
  EXPECT_TRUE(reader.problems().empty());
  EXPECT_EQ(4, reader.num_events());
}

TEST(LogFile, WritesTheStockFormat) {
  const test::TempFile file(".lcm");
  {
    LogWriter log(file.path());
    log.write(0x0102030405060708, "AB", Bytes{0xFF, 0x00});
    log.close();
  }
  const std::string expected(
      "\xED\xA1\xDA\x01\0\0\0\0\0\0\0\0\1\2\3\4\5\6\7\x08\0\0\0\2\0\0\0\2"
      "AB\xFF\0",
      32);
  EXPECT_EQ(expected, file.read());
}

TEST(LogFile, KeepsEveryWholeEventOfATruncatedLogWhereverItIsCut) {
  const test::TempFile whole(".lcm");
  write_sample(whole.path());
  const std::string bytes = whole.read();
  const test::TempFile cut(".lcm");
  // Cuts at every length around the borders of events, and in coarse steps through the long one.
  for (std::size_t length = 1; length < bytes.size(); length += length % 997 < 200 ? 1 : 499) {
    cut.write(bytes.substr(0, length));
    std::size_t whole_events = 0;
    while (whole_events < 4 && offset_of(whole_events + 1) <= static_cast<std::int64_t>(length))
      ++whole_events;
    const Contents contents = read_all(cut.path());
    ASSERT_EQ(whole_events, contents.times.size()) << "cut to " << length;
    const bool at_border = offset_of(whole_events) == static_cast<std::int64_t>(length);
    ASSERT_EQ(at_border ? 0U : 1U, contents.problems.size()) << "cut to " << length;
  }
}

TEST(LogFile, SaysWhatIsMissingFromATruncatedLog) {
  const Contents contents =
      read_damaged([](std::string* bytes) { bytes->resize(bytes->size() - 5); });
  EXPECT_EQ((Times{1000, 1001, 1002}), contents.times);
  EXPECT_EQ((Problems{"byte 100108: event of 45 bytes is cut off: 5 are missing"}),
            contents.problems);
}

TEST(LogFile, SkipsADamagedSyncWordAndGoesOn) {
  const Contents contents = read_damaged(
      [](std::string* bytes) { (*bytes)[static_cast<std::size_t>(offset_of(1))] = 'x'; });
  EXPECT_EQ((Times{1000, 1002, 1003}), contents.times);
  EXPECT_EQ((Problems{"byte 37: no event begins here (no sync word)"}), contents.problems);
}

TEST(LogFile, SkipsDamagedLengthsAndLosesOnlyThatEvent) {
  const auto channel_length = static_cast<std::size_t>(offset_of(1)) + 20;
  const auto data_length = static_cast<std::size_t>(offset_of(1)) + 24;
  Contents contents = read_damaged([&](std::string* bytes) { (*bytes)[channel_length] = '\xFF'; });
  EXPECT_EQ((Times{1000, 1002, 1003}), contents.times);
  EXPECT_EQ((Problems{"byte 37: channel length -16777207 is outside [1, 63]"}), contents.problems);

  contents = read_damaged([&](std::string* bytes) { (*bytes)[data_length] = '\x7F'; });
  EXPECT_EQ((Times{1000, 1002, 1003}), contents.times);
  EXPECT_EQ((Problems{"byte 37: data length 2130706432 is outside [0, 67108864]"}),
            contents.problems);

  // This length is plausible but covers the next event as well.
  contents = read_damaged([&](std::string* bytes) { (*bytes)[data_length + 3] = '\x40'; });
  EXPECT_EQ((Times{1000, 1002, 1003}), contents.times);
  EXPECT_EQ((Problems{"byte 37: the lengths of this event are damaged"}), contents.problems);
}

TEST(LogFile, KeepsAnEventThatRubbishFollows) {
  const Contents contents = read_damaged(
      [](std::string* bytes) { bytes->insert(static_cast<std::size_t>(offset_of(2)), "rubbish"); });
  EXPECT_EQ((Times{1000, 1001, 1002, 1003}), contents.times);
  EXPECT_EQ((Problems{"byte 74: no event begins here (no sync word)"}), contents.problems);
}

TEST(LogFile, FindsTheEventsBehindRubbishThatLooksLikeASyncWord) {
  const Contents contents = read_damaged(
      [](std::string* bytes) { bytes->insert(0, "\xED\xA1\xDA\x01\xED\xA1\xDA\xED\xA1", 9); });
  EXPECT_EQ((Times{1000, 1001, 1002, 1003}), contents.times);
  EXPECT_EQ(1U, contents.problems.size());
}

TEST(LogFile, ReportsAnEmptyFileAndOneThatIsNoLog) {
  const test::TempFile empty(".lcm");
  EXPECT_EQ((Problems{"byte 0: the file is empty"}), read_all(empty.path()).problems);
  const test::TempFile text(".lcm", std::string(1000, 'x'));
  const Contents contents = read_all(text.path());
  EXPECT_TRUE(contents.times.empty());
  EXPECT_EQ((Problems{"byte 0: no event begins here (no sync word)"}), contents.problems);
}

TEST(LogFile, SaysWhyAFileCannotBeOpened) {
  try {
    LogReader reader("/nowhere/drive.lcm");
    FAIL() << "opened a file that does not exist";
  } catch (const LogError& error) {
    EXPECT_STREQ("/nowhere/drive.lcm: cannot read: No such file or directory", error.what());
  }
  EXPECT_THROW(LogReader("/tmp"), LogError);
  EXPECT_THROW(LogWriter("/nowhere/drive.lcm"), LogError);
}

TEST(LogFile, ReportsAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  LogWriter log("/dev/full");
  const Bytes data(600'000);
  try {
    for (int i = 0; i < 4; ++i) log.write(i, "CAMERA", data);
    log.close();
    FAIL() << "a full disk was not reported";
  } catch (const LogError& error) {
    EXPECT_EQ(0U, std::string(error.what()).find("/dev/full: cannot write: No space left"))
        << error.what();
  }
}

TEST(LogFile, ReportsAFullDiskThatShowsOnlyWhenClosing) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  LogWriter log("/dev/full");
  log.write(0, "CAMERA", Bytes(10));
  EXPECT_THROW(log.close(), LogError);
}

TEST(LogFile, RefusesEventsThatNoReaderWouldTake) {
  const test::TempFile file(".lcm");
  LogWriter log(file.path());
  EXPECT_THROW(log.write(0, "", Bytes(1)), LogError);
  EXPECT_THROW(log.write(0, std::string(64, 'C'), Bytes(1)), LogError);
  EXPECT_NO_THROW(log.write(0, std::string(63, 'C'), Bytes(1)));
}

}  // namespace
}  // namespace plumb
