#include "platform/memory_usage.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace plumb {

MemoryUsage memory_usage() {
  MemoryUsage usage;
  rusage self{};
  if (::getrusage(RUSAGE_SELF, &self) == 0) usage.peak_bytes = std::int64_t{self.ru_maxrss} * 1024;
  const int fd = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (fd < 0) return usage;
  // The file lists pages: total, then resident. stdio would allocate on each of two reads a second.
  std::array<char, 128> text{};
  if (::read(fd, text.data(), text.size() - 1) > 0) {
    char* resident = nullptr;
    (void)std::strtoll(text.data(), &resident, 10);
    usage.rss_bytes = std::strtoll(resident, nullptr, 10) * ::sysconf(_SC_PAGESIZE);
  }
  ::close(fd);
  return usage;
}

}  // namespace plumb
