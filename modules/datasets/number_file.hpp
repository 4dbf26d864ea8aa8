/// Reads text files of numbers: one row per line, columns separated by blanks. A line that begins
/// with # is a comment.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

struct NumberRow {
  int line = 0;  ///< number of the line, from 1, for error messages
  std::vector<double> values;
};

/// Parses `text` as one finite number, independently of the locale. Returns nothing when the whole
/// text is not such a number.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// Splits `line` into words, which blanks and tabs separate.
[[nodiscard]] std::vector<std::string_view> split_words(std::string_view line);

/// Splits `line` at its commas and removes the blanks around each cell. Quotes have no meaning.
[[nodiscard]] std::vector<std::string_view> split_cells(std::string_view line);

/// Reads every line of a text file, without line ends and without the byte order mark that some
/// editors put before the first one. Throws InputError when it cannot be read.
[[nodiscard]] std::vector<std::string> read_lines(const std::filesystem::path& path);

/// Reads every row of `path` and skips empty lines and comments. Throws InputError for an
/// unreadable file, a word that is not a finite number, and a row with fewer than `min_columns` or
/// more than `max_columns` numbers.
[[nodiscard]] std::vector<NumberRow> read_number_rows(const std::filesystem::path& path,
                                                      std::size_t min_columns,
                                                      std::size_t max_columns);

}  // namespace plumb
