/// Eight floats at once, for image patches. GCC/Clang vector extensions: any machine, the same results.
#pragma once

#include <cstdint>
#include <cstring>
#if defined(__AVX2__)
#include <immintrin.h>
#endif

// Vectors are only passed between inlined functions here, so the ABI note does not apply.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace plumb::vo {

using Float8 = float __attribute__((vector_size(32)));

/// The eight bytes at `p` as floats.
[[gnu::always_inline]] inline Float8 load_bytes(const std::uint8_t* p) {
#if defined(__AVX2__)
  // GCC 12 turns the portable form below into eight scalar conversions.
  std::int64_t bytes;
  std::memcpy(&bytes, p, sizeof bytes);
  return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_cvtsi64_si128(bytes)));
#else
  Float8 v;
  for (int i = 0; i < 8; ++i) v[i] = static_cast<float>(p[i]);
  return v;
#endif
}

[[gnu::always_inline]] inline Float8 load_floats(const float* p) {
  Float8 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

[[gnu::always_inline]] inline void store_floats(const Float8& v, float* p) {
  std::memcpy(p, &v, sizeof v);
}

/// Sum of the lanes, always in the same order.
[[gnu::always_inline]] inline float lane_sum(const Float8& v) {
  const float low = (v[0] + v[4]) + (v[2] + v[6]);
  const float high = (v[1] + v[5]) + (v[3] + v[7]);
  return low + high;
}

}  // namespace plumb::vo
