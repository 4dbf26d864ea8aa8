/// A table of comma-separated values whose columns are found by the names in its first line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

class CsvTable {
 public:
  /// Throws InputError with file and line when the file is empty or a row has too few or too many
  /// cells.
  explicit CsvTable(std::filesystem::path path);
  /// The same for lines that are in memory; messages call them `name`.
  CsvTable(std::string name, const std::vector<std::string>& lines);

  /// Throws InputError when one of `columns` is missing.
  void require(const std::vector<std::string>& columns) const;

  [[nodiscard]] std::size_t num_rows() const { return rows_.size(); }
  /// "FILE:LINE: " of a row, for messages about its content.
  [[nodiscard]] std::string at(std::size_t row) const;
  /// Returns nothing when there is no such column.
  [[nodiscard]] std::optional<std::string_view> text(std::size_t row,
                                                     std::string_view column) const;
  /// Returns nothing for an empty cell and for `nan`. Throws InputError for other text that is no
  /// number.
  [[nodiscard]] std::optional<double> number(std::size_t row, std::string_view column) const;

 private:
  struct Row {
    int line = 0;
    std::vector<std::string> cells;
  };
  std::filesystem::path path_;
  std::vector<std::string> header_;
  std::vector<Row> rows_;
};

}  // namespace plumb
