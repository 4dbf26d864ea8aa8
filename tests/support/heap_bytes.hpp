/// Bytes of the heap in use: what malloc has handed out and not got back. Zero where a sanitizer owns malloc.
#pragma once

#include <malloc.h>

#include <cstddef>

namespace plumb::test {

inline std::size_t heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace plumb::test
