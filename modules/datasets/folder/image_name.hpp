/// What the names of images say: their order, the number of the frame, the time.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

/// A text of a name and the number behind it: "cam0_0012" is {"cam", "0"}, {"_", "12"}, {"", ""}.
struct NamePiece {
  std::string text;
  std::size_t num_digits = 0;  ///< stands before `digits`, so that numbers compare by their value
  std::string digits;          ///< without leading zeros, except for "0"

  auto operator<=>(const NamePiece&) const = default;
};

struct ImageName {
  std::filesystem::path path;
  std::vector<NamePiece> pieces;  ///< names compare as these do
  /// Time since 1970, when the name ends in one: 19 digits [ns], 16 [us], 13 [ms], or 10 digits
  /// with a decimal point and further ones [s], none of them with a leading zero.
  std::optional<std::int64_t> time_us;
  std::string before_time;  ///< the text before the time
};

/// Takes the name of a file apart, without its last extension.
[[nodiscard]] ImageName read_image_name(const std::filesystem::path& path);

/// The numbers that count the images: those in which the names differ, when they differ in one
/// number only and increase. Nothing when they do not, or when more than nine in ten numbers are
/// missing between multiples of the smallest step.
[[nodiscard]] std::optional<std::vector<std::int64_t>> count_by_names(
    const std::vector<ImageName>& names);

/// Greatest common divisor of the steps between `numbers`; 1 for a single number.
[[nodiscard]] std::int64_t common_step(const std::vector<std::int64_t>& numbers);

/// True when every name ends in a time, behind the same text.
[[nodiscard]] bool are_named_by_time(const std::vector<ImageName>& names);

}  // namespace plumb
