#include "modules/can/can_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace plumb::can_text {
namespace {

std::string upper(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

/// Name of a raw value whose bits are named, "NONE", "ALL" or "DENSE_POINTS".
std::string flags_name(std::span<const char* const> names, std::size_t bits) {
  if (bits == 0) return "NONE";
  if (bits + 1 == std::size_t{1} << names.size()) return "ALL";
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if ((bits >> i & 1U) != 0) text.append(text.empty() ? "" : "_").append(upper(names[i]));
  }
  return text;
}

}  // namespace

std::string number_text(double value) {
  constexpr int kDecimals = 9;
  std::array<char, 64> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value,
                                    std::chars_format::fixed, kDecimals);
  std::string out(text.data(), result.ptr);
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out;
}

std::string with_index(std::string text, std::size_t index) {
  std::replace(text.begin(), text.end(), '#', static_cast<char>('0' + index));
  return text;
}

bool has_sna(const Signal& signal) {
  return signal.layout.has_sna && source_of(signal) != CanSource::kFraming;
}

std::vector<std::string> value_names(const Signal& signal) {
  const std::size_t num_names =
      signal.names_are_flags ? std::size_t{1} << signal.names.size() : signal.names.size();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < num_names; ++i)
    names.push_back(signal.names_are_flags ? flags_name(signal.names, i) : upper(signal.names[i]));
  return names;
}

}  // namespace plumb::can_text
