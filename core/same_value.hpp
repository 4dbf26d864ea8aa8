/// Compares enumerators with the constants of messages, for the static_asserts of the wires.
#pragma once

#include <cstdint>

namespace plumb {

/// True when the enumerator `ours` has the number of the message constant `theirs`.
template <typename Ours>
constexpr bool same(Ours ours, std::int8_t theirs) {
  return static_cast<std::int8_t>(ours) == theirs;
}

}  // namespace plumb
