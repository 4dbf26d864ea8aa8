/// Memory of this process as the kernel sees it.
#pragma once

#include <cstdint>

namespace plumb {

struct MemoryUsage {
  std::int64_t rss_bytes = 0;  ///< 0 where the kernel does not say
  std::int64_t peak_bytes = 0;
};

[[nodiscard]] MemoryUsage memory_usage();

}  // namespace plumb
