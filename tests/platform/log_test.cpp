// Tests that log lines never wait for whoever reads them.
#include "platform/log.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string>

namespace plumb {
namespace {

/// Puts a descriptor in the place of stderr for the time of a test.
class Stderr {
 public:
  explicit Stderr(int fd) : before_(::dup(STDERR_FILENO)) {
    ::dup2(fd, STDERR_FILENO);
    ::close(fd);
  }
  ~Stderr() {
    ::dup2(before_, STDERR_FILENO);
    ::close(before_);
  }
  Stderr(const Stderr&) = delete;
  Stderr& operator=(const Stderr&) = delete;

 private:
  int before_;
};

std::string read_all(int fd) {
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = ::read(fd, part.data(), part.size())) > 0;)
    text.append(part.data(), static_cast<std::size_t>(n));
  return text;
}

/// Logs more than the channel holds, then reads it, then logs once more.
void expect_dropped_and_counted(int read_end, int write_end) {
  constexpr int kNumLines = 20'000;
  const Stderr replaced(write_end);
  for (int i = 0; i < kNumLines; ++i) log_line("line %d", i);
  const std::string first = read_all(read_end);
  EXPECT_NE(first.find("plumb: line 0\n"), std::string::npos);
  EXPECT_EQ(first.find("line 19999"), std::string::npos);
  EXPECT_EQ(first.back(), '\n') << "whole lines only";
  long num_read = 0;
  for (const char c : first) num_read += c == '\n' ? 1 : 0;
  log_line("at last");
  EXPECT_EQ(read_all(read_end), "plumb: " + std::to_string(kNumLines - num_read) +
                                    " lines before this one were dropped: nobody read them\n"
                                    "plumb: at last\n");
}

TEST(Log, APipeThatNobodyReadsDropsLinesAndCountsThem) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  expect_dropped_and_counted(ends[0], ends[1]);
  ::close(ends[0]);
}

TEST(Log, SoDoesASocketThatNobodyReads) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  expect_dropped_and_counted(ends[0], ends[1]);
  ::close(ends[0]);
}

TEST(Log, AFileTakesEveryLine) {
  std::FILE* const file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  {
    const Stderr replaced(::dup(::fileno(file)));
    for (int i = 0; i < 1000; ++i) log_line("line %d", i);
  }
  std::rewind(file);
  const std::string text = read_all(::fileno(file));
  EXPECT_NE(text.find("line 0\n"), std::string::npos);
  EXPECT_NE(text.find("line 999\n"), std::string::npos);
  std::fclose(file);
}

TEST(Log, LinesForTheJournalBeginWithTheirPriority) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  struct stat pipe {};
  ASSERT_EQ(::fstat(ends[1], &pipe), 0);
  const std::string stream = std::to_string(pipe.st_dev) + ":" + std::to_string(pipe.st_ino);
  const Stderr replaced(ends[1]);
  ::setenv("JOURNAL_STREAM", stream.c_str(), 1);
  log_line("all is well");
  log_warning("a file is missing");
  log_limited("a message was refused");
  log_error("no network");
  ::setenv("JOURNAL_STREAM", "1:1", 1);
  log_error("into another pipe");
  ::unsetenv("JOURNAL_STREAM");
  EXPECT_EQ(read_all(ends[0]),
            "<6>plumb: all is well\n<4>plumb: a file is missing\n<4>plumb: a message was refused\n"
            "<3>plumb: no network\nplumb: into another pipe\n");
  ::close(ends[0]);
}

}  // namespace
}  // namespace plumb
