#pragma once

#include <cstdint>
#include <limits>

namespace plumb {

/// a - b; the end of the range where the difference does not fit.
[[nodiscard]] inline std::int64_t stamp_difference(std::int64_t a, std::int64_t b) {
  std::int64_t result = 0;
  if (!__builtin_sub_overflow(a, b, &result)) return result;
  using Limits = std::numeric_limits<std::int64_t>;
  return a > b ? Limits::max() : Limits::min();
}

}  // namespace plumb
