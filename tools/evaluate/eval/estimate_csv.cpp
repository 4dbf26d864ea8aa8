#include "tools/evaluate/eval/estimate_csv.hpp"

#include "core/input_error.hpp"
#include "tools/support/csv_table.hpp"

namespace plumb {
namespace {

EstimatedPlane plane_of(const CsvTable& table, std::size_t row) {
  EstimatedPlane plane;
  const std::optional<double> seq = table.number(row, "seq");
  if (!seq) throw InputError(table.at(row) + "seq is empty");
  plane.seq = static_cast<std::int64_t>(*seq);
  plane.status = std::string(table.text(row, "plane_status").value_or(""));
  plane.height_m = table.number(row, "height_m");
  plane.pitch_rad = table.number(row, "pitch_rad");
  plane.roll_rad = table.number(row, "roll_rad");
  plane.height_std_m = table.number(row, "height_std_m");
  plane.pitch_std_rad = table.number(row, "pitch_std_rad");
  plane.roll_std_rad = table.number(row, "roll_std_rad");
  return plane;
}

}  // namespace

std::vector<EstimatedPlane> read_estimate_csv(const std::filesystem::path& path) {
  const CsvTable table(path);
  table.require({"seq", "height_m", "pitch_rad", "roll_rad"});
  std::vector<EstimatedPlane> planes;
  for (std::size_t row = 0; row < table.num_rows(); ++row) planes.push_back(plane_of(table, row));
  return planes;
}

}  // namespace plumb
