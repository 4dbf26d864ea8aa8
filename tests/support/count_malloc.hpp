/// Counts every malloc of this program, including those of Eigen and operator new. Include this in
/// exactly one file of a test program. Under a sanitizer,
/// which replaces malloc, nothing is counted.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace plumb::test {

inline std::atomic<std::int64_t> g_num_mallocs{0};

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kCountsMallocs = false;
#else
inline constexpr bool kCountsMallocs = true;
#endif

}  // namespace plumb::test

#if !defined(__SANITIZE_ADDRESS__)
// glibc documents these entry points for programs that replace malloc.
extern "C" void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier)
extern "C" void* __libc_calloc(std::size_t, std::size_t);    // NOLINT(bugprone-reserved-identifier)
extern "C" void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)

extern "C" void* malloc(std::size_t bytes) noexcept {
  ++plumb::test::g_num_mallocs;
  return __libc_malloc(bytes);
}
extern "C" void* calloc(std::size_t count, std::size_t bytes) noexcept {
  ++plumb::test::g_num_mallocs;
  return __libc_calloc(count, bytes);
}
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t bytes) noexcept {
  ++plumb::test::g_num_mallocs;
  return __libc_memalign(alignment, bytes);
}
#endif
