/// The number of heap bytes in use, which malloc allocated and free did not release. It is zero
/// where a sanitizer replaces malloc.
#pragma once

#include <malloc.h>

#include <cstddef>

namespace plumb::test {

inline std::size_t heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace plumb::test
