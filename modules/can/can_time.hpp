/// Ages on a clock that anybody may have set.
#pragma once

#include <cstdint>

namespace plumb {

/// Age of `then_us`; never negative, and the largest there is when the clock went backwards.
[[nodiscard]] constexpr std::int64_t age_us(std::int64_t now_us, std::int64_t then_us) {
  if (now_us < then_us) return INT64_MAX;
  const auto age = static_cast<std::uint64_t>(now_us) - static_cast<std::uint64_t>(then_us);
  return age > static_cast<std::uint64_t>(INT64_MAX) ? INT64_MAX : static_cast<std::int64_t>(age);
}

}  // namespace plumb
