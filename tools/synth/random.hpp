/// Counter-based random numbers. A value depends on its keys alone, and neither on the order nor on
/// the thread of the calls.
///
/// Source:
///   The finaliser of splitmix64.
#pragma once

#include <cmath>
#include <cstdint>

namespace plumb::synth {

[[nodiscard]] constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

[[nodiscard]] constexpr std::uint64_t hash_keys(std::uint64_t a, std::uint64_t b,
                                                std::uint64_t c = 0) {
  return mix(mix(mix(a) ^ b) ^ c);
}

/// A number in [0, 1).
[[nodiscard]] constexpr double uniform_of(std::uint64_t hash) {
  return static_cast<double>(hash >> 11) * 0x1.0p-53;
}

/// A stream of numbers for one purpose.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(mix(seed)) {}

  std::uint64_t next() { return mix(state_ += 0x9e3779b97f4a7c15ULL); }
  double uniform() { return uniform_of(next()); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  bool chance(double probability) { return uniform() < probability; }
  int below(int n) { return static_cast<int>(uniform() * n); }

  /// Standard normal (Box-Muller, one of the pair).
  double normal() {
    const double u = 1.0 - uniform();
    return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * uniform());
  }

 private:
  std::uint64_t state_;
};

}  // namespace plumb::synth
