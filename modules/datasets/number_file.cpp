#include "modules/datasets/number_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "core/input_error.hpp"

namespace plumb {
namespace {

std::string where(const std::filesystem::path& path, int line) {
  return path.string() + ":" + std::to_string(line) + ": ";
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

NumberRow parse_row(const std::filesystem::path& path, int line, std::string_view text) {
  NumberRow row;
  row.line = line;
  for (const std::string_view word : split_words(text)) {
    const std::optional<double> value = parse_number(word);
    if (!value) {
      throw InputError(where(path, line) + "'" + std::string(word) + "' is not a finite number");
    }
    row.values.push_back(*value);
  }
  return row;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return words;
    line.remove_prefix(first);
    const auto length = std::min(line.find_first_of(" \t\r"), line.size());
    words.push_back(line.substr(0, length));
    line.remove_prefix(length);
  }
}

std::vector<std::string_view> split_cells(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const auto comma = line.find(',');
    cells.push_back(trim(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

std::vector<std::string> read_lines(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path))
    throw InputError("cannot read " + path.string());
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (lines.empty() && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // a byte order mark
    lines.push_back(std::move(line));
  }
  if (file.bad()) throw InputError("cannot read " + path.string() + " to its end");
  return lines;
}

std::vector<NumberRow> read_number_rows(const std::filesystem::path& path, std::size_t min_columns,
                                        std::size_t max_columns) {
  std::vector<NumberRow> rows;
  int line = 0;
  for (const std::string& text : read_lines(path)) {
    ++line;
    const std::string_view content = trim(text);
    if (content.empty() || content.front() == '#') continue;
    rows.push_back(parse_row(path, line, content));
    const std::size_t columns = rows.back().values.size();
    if (columns < min_columns || columns > max_columns) {
      throw InputError(where(path, line) + std::to_string(columns) + " numbers, expected " +
                       std::to_string(min_columns) + (max_columns > min_columns ? " or more" : ""));
    }
  }
  return rows;
}

}  // namespace plumb
