/// Vectors of eight numbers in the compiler's own vector types. The same source compiles to AVX2,
/// to NEON and to scalar code.
///
/// The lanes are summed in a fixed order, so that results do not depend on the width of the
/// machine's vector registers.
#pragma once

#include <cstdint>
#include <cstring>
#if defined(__AVX2__)
#include <immintrin.h>
#endif

// GCC warns that the calling convention for these vectors depends on the target. All functions that
// take or return them are inlined, so the warning does not apply.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace plumb {

inline constexpr int kNumLanes = 8;
using Float8 = float __attribute__((vector_size(kNumLanes * sizeof(float))));
using Int8 = std::int32_t __attribute__((vector_size(kNumLanes * sizeof(std::int32_t))));

/// Loads eight bytes from `p` and converts them to floats.
[[gnu::always_inline]] inline Float8 load_bytes(const std::uint8_t* p) {
#if defined(__AVX2__)
  // GCC 12 compiles the portable form below to eight scalar conversions.
  std::int64_t bytes;
  std::memcpy(&bytes, p, sizeof bytes);
  return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_cvtsi64_si128(bytes)));
#else
  Float8 v;
  for (int i = 0; i < kNumLanes; ++i) v[i] = static_cast<float>(p[i]);
  return v;
#endif
}

/// Loads eight floats from `p`, which may have any alignment.
[[gnu::always_inline]] inline Float8 load_floats(const float* p) {
  Float8 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

/// Stores eight floats to `p`, which may have any alignment.
[[gnu::always_inline]] inline void store_floats(const Float8& v, float* p) {
  std::memcpy(p, &v, sizeof v);
}

/// Sums the lanes in single precision.
[[gnu::always_inline]] inline float sum_float(const Float8& v) {
  const float low = (v[0] + v[4]) + (v[2] + v[6]);
  const float high = (v[1] + v[5]) + (v[3] + v[7]);
  return low + high;
}

/// Sums the lanes in double precision.
[[nodiscard]] inline double sum_double(const Float8& v) {
  const double s04 = static_cast<double>(v[0]) + static_cast<double>(v[4]);
  const double s15 = static_cast<double>(v[1]) + static_cast<double>(v[5]);
  const double s26 = static_cast<double>(v[2]) + static_cast<double>(v[6]);
  const double s37 = static_cast<double>(v[3]) + static_cast<double>(v[7]);
  return (s04 + s26) + (s15 + s37);
}

}  // namespace plumb
