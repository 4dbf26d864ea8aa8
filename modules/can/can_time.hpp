/// Ages on a clock that may have been set in between.
#pragma once

#include <cstdint>

namespace plumb {

/// Returns the age of `then_us`; it is never negative, and INT64_MAX when the clock went backwards.
[[nodiscard]] constexpr std::int64_t age_us(std::int64_t now_us, std::int64_t then_us) {
  if (now_us < then_us) return INT64_MAX;
  const auto age = static_cast<std::uint64_t>(now_us) - static_cast<std::uint64_t>(then_us);
  return age > static_cast<std::uint64_t>(INT64_MAX) ? INT64_MAX : static_cast<std::int64_t>(age);
}

}  // namespace plumb
