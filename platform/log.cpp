#include "platform/log.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "platform/clock.hpp"

namespace plumb {
namespace {

constexpr std::int64_t kQuiet_us = 1'000'000;

struct Site {
  const char* format = nullptr;
  std::int64_t next_us = 0;
  std::int64_t num_suppressed = 0;
};

const char* g_name = "plumb";
std::array<Site, 32> g_sites;

std::int64_t g_num_dropped = 0;  // since the newest line that was written

/// A descriptor of our own for the pipe or terminal behind stderr. Others share stderr itself, so
/// that it cannot be made non-blocking.
struct OwnStderr {
  int fd = -1;
  dev_t device = 0;
  ino_t inode = 0;
  bool is_open = false;

  /// Returns -1 when the system refuses one.
  int of(const struct stat& now) {
    if (is_open && now.st_dev == device && now.st_ino == inode) return fd;
    if (fd >= 0) ::close(fd);
    fd = ::open("/proc/self/fd/2", O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    device = now.st_dev;
    inode = now.st_ino;
    is_open = true;
    return fd;
  }
};
OwnStderr g_own_stderr;

/// Writes without waiting. Returns whether the text was taken.
bool write_now(const char* text, std::size_t size) {
  struct stat now {};
  if (::fstat(STDERR_FILENO, &now) != 0) return false;
  ssize_t n = -1;
  if (S_ISSOCK(now.st_mode)) {
    n = ::send(STDERR_FILENO, text, size, MSG_DONTWAIT | MSG_NOSIGNAL);
  } else if (S_ISFIFO(now.st_mode) || S_ISCHR(now.st_mode)) {
    const int own = g_own_stderr.of(now);
    pollfd ready{STDERR_FILENO, POLLOUT, 0};
    if (own >= 0) {
      n = ::write(own, text, size);
    } else if (::poll(&ready, 1, 0) == 1 && (ready.revents & POLLOUT) != 0) {
      n = ::write(STDERR_FILENO, text, size);
    }
  } else {
    n = ::write(STDERR_FILENO, text, size);
  }
  return n == static_cast<ssize_t>(size);
}

void write_line(const char* text, int size) {
  const auto bytes = static_cast<std::size_t>(size);
  if (g_num_dropped > 0) {
    std::array<char, 160> line{};
    const int n = std::snprintf(line.data(), line.size(),
                                "%s: %lld lines before this one were dropped: nobody read them\n",
                                g_name, static_cast<long long>(g_num_dropped));
    if (!write_now(line.data(), static_cast<std::size_t>(n))) {
      ++g_num_dropped;
      return;
    }
    g_num_dropped = 0;
  }
  if (!write_now(text, bytes)) ++g_num_dropped;
}

/// Priorities of syslog.
enum class Level : int { kError = 3, kWarning = 4, kInfo = 6 };

/// Is `now`, which is stderr, the stream that systemd connected to the journal?
bool is_journal(const struct stat& now) {
  const char* stream = std::getenv("JOURNAL_STREAM");
  unsigned long long device = 0;
  unsigned long long inode = 0;
  return stream != nullptr && std::sscanf(stream, "%llu:%llu", &device, &inode) == 2 &&
         device == now.st_dev && inode == now.st_ino;
}

void print(Level level, const char* format, std::va_list arguments, std::int64_t num_suppressed) {
  std::array<char, 512> line{};
  std::vsnprintf(line.data(), line.size(), format, arguments);
  std::array<char, 16> priority{};
  struct stat now {};
  if (::fstat(STDERR_FILENO, &now) == 0 && is_journal(now))
    std::snprintf(priority.data(), priority.size(), "<%d>", static_cast<int>(level));
  std::array<char, 640> text{};
  const int n = num_suppressed > 0
                    ? std::snprintf(text.data(), text.size(), "%s%s: %s (%lld more like it)\n",
                                    priority.data(), g_name, line.data(),
                                    static_cast<long long>(num_suppressed))
                    : std::snprintf(text.data(), text.size(), "%s%s: %s\n", priority.data(), g_name,
                                    line.data());
  write_line(text.data(), std::min(n, static_cast<int>(text.size()) - 1));
}

// When the table is full, further formats share its last entry. Their lines are then suppressed
// together, but each is counted.
Site& site_of(const char* format) {
  for (Site& site : g_sites) {
    if (site.format == format) return site;
    if (site.format == nullptr) {
      site.format = format;
      return site;
    }
  }
  return g_sites.back();
}

}  // namespace

void set_log_name(const char* name) { g_name = name; }

void log_line(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  print(Level::kInfo, format, arguments, 0);
  va_end(arguments);
}

void log_warning(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  print(Level::kWarning, format, arguments, 0);
  va_end(arguments);
}

void log_error(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  print(Level::kError, format, arguments, 0);
  va_end(arguments);
}

void log_limited(const char* format, ...) {
  Site& site = site_of(format);
  const std::int64_t now_us = monotonic_us();
  if (now_us < site.next_us) {
    ++site.num_suppressed;
    return;
  }
  std::va_list arguments;
  va_start(arguments, format);
  print(Level::kWarning, format, arguments, site.num_suppressed);
  va_end(arguments);
  site.num_suppressed = 0;
  site.next_us = now_us + kQuiet_us;
}

}  // namespace plumb
