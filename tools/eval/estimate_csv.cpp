#include "tools/eval/estimate_csv.hpp"

#include <algorithm>
#include <string_view>

#include "tools/support/input_error.hpp"
#include "tools/support/number_file.hpp"

namespace plumb {
namespace {

class CsvRow {
 public:
  CsvRow(const std::filesystem::path& path, const std::vector<std::string_view>& header)
      : path_(path), header_(header) {}

  void take(int line, std::string_view text) {
    line_ = line;
    cells_ = split_cells(text);
    if (cells_.size() == header_.size()) return;
    throw InputError(at() + std::to_string(cells_.size()) + " cells, the first line names " +
                     std::to_string(header_.size()));
  }

  [[nodiscard]] std::optional<std::string_view> cell(std::string_view name) const {
    const auto column = std::find(header_.begin(), header_.end(), name);
    if (column == header_.end()) return {};
    return cells_[static_cast<std::size_t>(column - header_.begin())];
  }

  /// Absent for an empty cell, and for `nan`, which says the same.
  [[nodiscard]] std::optional<double> number(std::string_view name) const {
    const std::optional<std::string_view> text = cell(name);
    if (!text || text->empty() || *text == "nan") return {};
    const std::optional<double> value = parse_number(*text);
    if (value) return value;
    throw InputError(at() + std::string(name) + ": '" + std::string(*text) + "' is not a number");
  }

  [[nodiscard]] std::string at() const {
    return path_.string() + ":" + std::to_string(line_) + ": ";
  }

 private:
  const std::filesystem::path& path_;
  const std::vector<std::string_view>& header_;
  int line_ = 0;
  std::vector<std::string_view> cells_;
};

EstimatedPlane plane_of(const CsvRow& row) {
  EstimatedPlane plane;
  const std::optional<double> seq = row.number("seq");
  if (!seq) throw InputError(row.at() + "seq is empty");
  plane.seq = static_cast<std::int64_t>(*seq);
  plane.status = std::string(row.cell("plane_status").value_or(""));
  plane.height_m = row.number("height_m");
  plane.pitch_rad = row.number("pitch_rad");
  plane.roll_rad = row.number("roll_rad");
  plane.height_std_m = row.number("height_std_m");
  plane.pitch_std_rad = row.number("pitch_std_rad");
  plane.roll_std_rad = row.number("roll_std_rad");
  return plane;
}

}  // namespace

std::vector<EstimatedPlane> read_estimate_csv(const std::filesystem::path& path) {
  const std::vector<std::string> lines = read_lines(path);
  if (lines.empty()) throw InputError(path.string() + " is empty");
  const std::vector<std::string_view> header = split_cells(lines.front());
  for (const char* name : {"seq", "height_m", "pitch_rad", "roll_rad"}) {
    if (std::find(header.begin(), header.end(), name) == header.end()) {
      throw InputError(path.string() + ":1: column " + name + " is missing");
    }
  }
  std::vector<EstimatedPlane> planes;
  CsvRow row(path, header);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].empty()) continue;
    row.take(static_cast<int>(i) + 1, lines[i]);
    planes.push_back(plane_of(row));
  }
  return planes;
}

}  // namespace plumb
