#include "tools/run/draw/figures.hpp"

#include <cmath>

#include "core/input_error.hpp"
#include "core/numbers.hpp"
#include "modules/datasets/text.hpp"
#include "tools/support/csv_table.hpp"

namespace plumb {
namespace {

std::string text_of(const CsvTable& table, std::size_t row, const char* column) {
  return std::string(table.text(row, column).value_or("-"));
}

/// "name value +- standard deviation unit", or "name -" while the value is not valid.
std::string figure(const CsvTable& table, std::size_t row, const char* name, const char* column,
                   const char* std_column, double factor, const char* unit) {
  const auto value = table.number(row, column);
  const auto deviation = table.number(row, std_column);
  if (!value) return std::string(name) + " -";
  return format("%s %.2f +- %.2f %s", name, factor * *value, factor * deviation.value_or(0.0),
                unit);
}

FrameFigures figures_of(const CsvTable& table, std::size_t row) {
  FrameFigures figures;
  const auto n1 = table.number(row, "n1"), n2 = table.number(row, "n2"),
             n3 = table.number(row, "n3"), height = table.number(row, "height_m");
  if (n1 && n2 && n3 && height) figures.plane = RoadPlane{{*n1, *n2, *n3}, *height};
  figures.lines = {
      format("frame %s, vo %s, plane %s, motion %s", text_of(table, row, "seq").c_str(),
             text_of(table, row, "vo_status").c_str(), text_of(table, row, "plane_status").c_str(),
             text_of(table, row, "ego_status").c_str()),
      figure(table, row, "speed", "speed_m_s", "speed_std_m_s", 1.0, "m/s"),
      figure(table, row, "pitch", "pitch_rad", "pitch_std_rad", degrees(1.0), "deg"),
      figure(table, row, "roll", "roll_rad", "roll_std_rad", degrees(1.0), "deg"),
      figure(table, row, "height", "height_m", "height_std_m", 1.0, "m"),
  };
  return figures;
}

}  // namespace

void read_objects(const std::filesystem::path& csv, std::map<std::int64_t, FrameFigures>* figures) {
  const CsvTable table(csv);
  table.require(
      {"seq", "class", "status", "x_m", "y_m", "yaw_rad", "length_m", "width_m", "height_m"});
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    const auto cell = [&](const char* column) { return table.number(row, column); };
    const auto seq = cell("seq");
    if (!seq) throw InputError(table.at(row) + "seq is empty");
    const auto frame = figures->find(static_cast<std::int64_t>(*seq));
    const auto x = cell("x_m"), y = cell("y_m"), yaw = cell("yaw_rad");
    const auto length = cell("length_m"), width = cell("width_m"), height = cell("height_m");
    if (frame == figures->end() || !x || !y || !yaw || !length || !width || !height) continue;
    ObjectFigure object{{*x, *y}, *yaw, {*length, *width, *height}, false, ""};
    object.measured = text_of(table, row, "status") == "measured";
    object.label = format("%s %.0f m", text_of(table, row, "class").c_str(), std::hypot(*x, *y));
    frame->second.objects.push_back(std::move(object));
  }
}

std::map<std::int64_t, FrameFigures> read_figures(const std::filesystem::path& csv) {
  const CsvTable table(csv);
  table.require({"seq", "n1", "n2", "n3", "height_m", "x_m", "z_m"});
  std::map<std::int64_t, FrameFigures> figures;
  std::vector<Eigen::Vector2d> path_m;
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    const auto seq = table.number(row, "seq");
    if (!seq) throw InputError(table.at(row) + "seq is empty");
    FrameFigures frame = figures_of(table, row);
    const auto x = table.number(row, "x_m"), z = table.number(row, "z_m");
    if (x && z) path_m.emplace_back(*x, *z);
    frame.path_m = path_m;
    figures.emplace(static_cast<std::int64_t>(*seq), std::move(frame));
  }
  return figures;
}

}  // namespace plumb
