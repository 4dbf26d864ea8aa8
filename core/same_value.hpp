#pragma once

#include <cstdint>

namespace plumb {

/// Whether an enumerator has the number of a message's constant; for the static_asserts of the wires.
template <typename Ours>
constexpr bool same(Ours ours, std::int8_t theirs) {
  return static_cast<std::int8_t>(ours) == theirs;
}

}  // namespace plumb
