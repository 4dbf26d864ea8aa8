/// Text files of numbers: one row per line, columns apart by blanks, `#` begins a comment line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

struct NumberRow {
  int line = 0;  ///< 1-based, for messages
  std::vector<double> values;
};

/// The finite number that `text` is, all of it; nothing otherwise. Independent of the locale.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// Words of `line`, apart by blanks and tabs.
[[nodiscard]] std::vector<std::string_view> split_words(std::string_view line);

/// Cells of a comma-separated `line`, blanks around them removed. No quoting.
[[nodiscard]] std::vector<std::string_view> split_cells(std::string_view line);

/// Every line of a text file without its line end. Throws InputError when it cannot be read.
[[nodiscard]] std::vector<std::string> read_lines(const std::filesystem::path& path);

/// Every row of `path`; empty lines and lines that begin with # are left out.
/// Throws InputError for an unreadable file, a word that is not a finite number, and a row with
/// fewer than `min_columns` or more than `max_columns`.
[[nodiscard]] std::vector<NumberRow> read_number_rows(const std::filesystem::path& path,
                                                      std::size_t min_columns,
                                                      std::size_t max_columns);

}  // namespace plumb
