/// Eight floats side by side, in the compiler's own vector type: one source for AVX2, NEON and
/// plain code.
///
/// Sums over lanes are taken in a fixed order, so results do not depend on the machine's vector
/// width.
#pragma once

#include <cstdint>
#include <cstring>

namespace plumb {

inline constexpr int kLanes = 8;
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));
using IntLanes = std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t))));

/// @pre `from` holds kLanes values; no alignment needed
inline void load(const float* from, Lanes* to) { std::memcpy(to, from, sizeof(Lanes)); }
inline void store(const Lanes& from, float* to) { std::memcpy(to, &from, sizeof(Lanes)); }

/// Sum over the lanes, pairwise.
[[nodiscard]] inline double sum_lanes(const Lanes& v) {
  const double s04 = static_cast<double>(v[0]) + static_cast<double>(v[4]);
  const double s15 = static_cast<double>(v[1]) + static_cast<double>(v[5]);
  const double s26 = static_cast<double>(v[2]) + static_cast<double>(v[6]);
  const double s37 = static_cast<double>(v[3]) + static_cast<double>(v[7]);
  return (s04 + s26) + (s15 + s37);
}

}  // namespace plumb
