/// The memory of this process as the kernel accounts it.
#pragma once

#include <cstdint>

namespace plumb {

struct MemoryUsage {
  std::int64_t rss_bytes = 0;  ///< 0 where the kernel does not report it
  std::int64_t peak_bytes = 0;
};

[[nodiscard]] MemoryUsage memory_usage();

}  // namespace plumb
