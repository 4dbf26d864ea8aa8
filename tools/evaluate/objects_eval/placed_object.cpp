#include "tools/evaluate/objects_eval/placed_object.hpp"

#include <cmath>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"
#include "tools/support/csv_table.hpp"

namespace plumb {
namespace {

double needed(const CsvTable& table, std::size_t row, const char* column) {
  if (const auto value = table.number(row, column)) return *value;
  throw InputError(table.at(row) + column + " is empty");
}

std::int64_t whole(const CsvTable& table, std::size_t row, const char* column) {
  const double value = needed(table, row, column);
  if (std::abs(value) < 1e15 && value == std::floor(value)) return static_cast<std::int64_t>(value);
  throw InputError(table.at(row) + column + format(" = %g is not a whole number", value));
}

PlacedObject object_of(const CsvTable& table, std::size_t row) {
  PlacedObject object;
  object.position_m = {needed(table, row, "x_m"), needed(table, row, "y_m")};
  const double x_std_m = needed(table, row, "x_std_m");
  const double y_std_m = needed(table, row, "y_std_m");
  const double xy_m2 = needed(table, row, "xy_cov_m2");
  object.cov_m2 << x_std_m * x_std_m, xy_m2, xy_m2, y_std_m * y_std_m;
  if (x_std_m > 0.0 && y_std_m > 0.0 && std::abs(xy_m2) < x_std_m * y_std_m) return object;
  throw InputError(table.at(row) +
                   format("x_std_m = %g, y_std_m = %g, xy_cov_m2 = %g are no covariance", x_std_m,
                          y_std_m, xy_m2));
}

}  // namespace

PlacedObjects read_placed_objects(const std::filesystem::path& csv) {
  const CsvTable table(csv);
  table.require({"seq", "track_id", "x_m", "x_std_m", "y_m", "y_std_m", "xy_cov_m2"});
  PlacedObjects objects;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    const std::int64_t seq = whole(table, row, "seq");
    const std::int64_t track_id = whole(table, row, "track_id");
    if (!table.number(row, "x_m")) continue;
    if (objects.emplace(std::pair(seq, track_id), object_of(table, row)).second) continue;
    throw InputError(table.at(row) + format("track %lld has two rows in image %lld",
                                            static_cast<long long>(track_id),
                                            static_cast<long long>(seq)));
  }
  return objects;
}

}  // namespace plumb
