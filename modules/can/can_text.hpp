/// Text that the printers of the DBC and of the C header share.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "modules/can/can_signal.hpp"

namespace plumb::can_text {

template <typename... Parts>
std::string join(const Parts&... parts) {
  std::string text;
  (text.append(std::string_view(parts)), ...);
  return text;
}

/// Decimal text, without exponent and trailing zeros.
[[nodiscard]] std::string number_text(double value);

/// The text with the index in place of each #.
[[nodiscard]] std::string with_index(std::string text, std::size_t index);

/// Has the signal a raw value that means "not available"?
[[nodiscard]] bool has_sna(const Signal& signal);

/// Names of the raw values 0, 1, 2, ... in capitals.
[[nodiscard]] std::vector<std::string> value_names(const Signal& signal);

}  // namespace plumb::can_text
