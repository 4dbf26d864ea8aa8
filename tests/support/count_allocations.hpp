/// Counts calls of operator new in this program. Include it in exactly one file of a test program.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace plumb::test {
inline std::atomic<std::int64_t> g_num_allocations{0};
}  // namespace plumb::test

// noinline: gcc otherwise pairs the inlined malloc with operator delete and warns.
__attribute__((noinline)) void* operator new(std::size_t bytes) {
  ++plumb::test::g_num_allocations;
  void* block = std::malloc(bytes == 0 ? 1 : bytes);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
__attribute__((noinline)) void operator delete(void* block) noexcept { std::free(block); }
__attribute__((noinline)) void operator delete(void* block, std::size_t) noexcept {
  std::free(block);
}
