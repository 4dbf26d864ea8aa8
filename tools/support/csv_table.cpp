#include "tools/support/csv_table.hpp"

#include <algorithm>
#include <utility>

#include "core/input_error.hpp"
#include "modules/datasets/number_file.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

std::vector<std::string> cells_of(std::string_view line) {
  const std::vector<std::string_view> views = split_cells(line);
  return {views.begin(), views.end()};
}

}  // namespace

CsvTable::CsvTable(std::filesystem::path path) : CsvTable(path.string(), read_lines(path)) {}

CsvTable::CsvTable(std::string name, const std::vector<std::string>& lines)
    : path_(std::move(name)) {
  if (lines.empty()) throw InputError(path_.string() + " is empty");
  header_ = cells_of(lines.front());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].empty()) continue;
    rows_.push_back({static_cast<int>(i) + 1, cells_of(lines[i])});
    const std::size_t num_cells = rows_.back().cells.size();
    if (num_cells == header_.size()) continue;
    throw InputError(at(rows_.size() - 1) + std::to_string(num_cells) +
                     " cells, the first line names " + std::to_string(header_.size()));
  }
}

void CsvTable::require(const std::vector<std::string>& columns) const {
  for (const std::string& column : columns) {
    if (std::find(header_.begin(), header_.end(), column) != header_.end()) continue;
    throw InputError(path_.string() + ":1: column " + column + " is missing");
  }
}

std::string CsvTable::at(std::size_t row) const {
  return path_.string() + ":" + std::to_string(rows_[row].line) + ": ";
}

std::optional<std::string_view> CsvTable::text(std::size_t row, std::string_view column) const {
  const auto found = std::find(header_.begin(), header_.end(), column);
  if (found == header_.end()) return {};
  return rows_[row].cells[static_cast<std::size_t>(found - header_.begin())];
}

std::optional<double> CsvTable::number(std::size_t row, std::string_view column) const {
  const std::optional<std::string_view> cell = text(row, column);
  if (!cell || cell->empty() || *cell == "nan") return {};
  if (const std::optional<double> value = parse_number(*cell)) return value;
  throw InputError(at(row) + std::string(column) + ": '" + std::string(*cell) +
                   "' is not a number");
}

}  // namespace plumb
