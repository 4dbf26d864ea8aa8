/// A small generator of pseudo-random numbers (SplitMix64; Steele, Lea & Flood 2014). It returns
/// the same numbers on every machine, which std::uniform_int_distribution does not promise.
#pragma once

#include <cstdint>

namespace plumb::vo {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// Returns 64 random bits.
  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  /// Returns a number in [0, count), uniform up to a bias of count / 2^64. @pre count > 0
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }

 private:
  std::uint64_t state_;
};

}  // namespace plumb::vo
