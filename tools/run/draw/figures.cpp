#include "tools/run/draw/figures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/input_error.hpp"
#include "core/numbers.hpp"
#include "modules/datasets/text.hpp"
#include "plumb/status_names.hpp"

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

FrameFigures read_frame(const CsvTable& table, std::size_t row) {
  FrameFigures figures;
  const auto n1 = table.number(row, "n1"), n2 = table.number(row, "n2"),
             n3 = table.number(row, "n3"), height = table.number(row, "height_m");
  if (n1 && n2 && n3 && height) figures.plane = PlaneFigure{{*n1, *n2, *n3}, *height};
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

/// Sequence number of a row.
std::int64_t seq_of(const CsvTable& table, std::size_t row) {
  const auto seq = table.number(row, "seq");
  if (!seq) throw InputError(table.at(row) + "seq is empty");
  return static_cast<std::int64_t>(*seq);
}

FeatureKind kind_of(const CsvTable& table, std::size_t row) {
  const auto word = text_of(table, row, "kind");
  const auto found = std::find(kVoMotionFeatureNames.begin(), kVoMotionFeatureNames.end(), word);
  if (found == kVoMotionFeatureNames.end())
    throw InputError(table.at(row) + "kind: '" + word + "' is no kind of a feature");
  return static_cast<FeatureKind>(std::distance(kVoMotionFeatureNames.begin(), found));
}

}  // namespace

DriveFigures::DriveFigures(const CsvTable& frames) {
  frames.require({"seq", "n1", "n2", "n3", "height_m", "x_m", "z_m"});
  for (std::size_t row = 0; row < frames.num_rows(); ++row) {
    const auto x = frames.number(row, "x_m"), z = frames.number(row, "z_m");
    if (x && z) path_m_.emplace_back(*x, *z);
    places_.try_emplace(seq_of(frames, row), frames_.size());
    frames_.push_back({seq_of(frames, row), read_frame(frames, row), path_m_.size()});
  }
}

void DriveFigures::add_objects(const CsvTable& objects) {
  objects.require(
      {"seq", "class", "status", "x_m", "y_m", "yaw_rad", "length_m", "width_m", "height_m"});
  for (std::size_t row = 0; row < objects.num_rows(); ++row) {
    const auto cell = [&](const char* column) { return objects.number(row, column); };
    FrameFigures* frame = figures_of(objects, row);
    const auto x = cell("x_m"), y = cell("y_m"), yaw = cell("yaw_rad");
    const auto length = cell("length_m"), width = cell("width_m"), height = cell("height_m");
    if (frame == nullptr || !x || !y || !yaw || !length || !width || !height) continue;
    ObjectFigure object{{*x, *y}, *yaw, {*length, *width, *height}, false, ""};
    object.measured = text_of(objects, row, "status") == "measured";
    object.label = object_label(text_of(objects, row, "class"), object.place_m);
    frame->objects.push_back(std::move(object));
  }
}

void DriveFigures::add_features(const CsvTable& features) {
  features.require({"seq", "u_px", "v_px", "kind"});
  for (std::size_t row = 0; row < features.num_rows(); ++row) {
    const auto u = features.number(row, "u_px"), v = features.number(row, "v_px");
    const FeatureKind kind = kind_of(features, row);
    FrameFigures* frame = figures_of(features, row);
    if (frame == nullptr || !u || !v) continue;
    frame->features.push_back({Eigen::Vector2d(*u, *v).cast<float>(), kind});
  }
}

/// The figures of the frame that a row names, or null when there is no such frame.
FrameFigures* DriveFigures::figures_of(const CsvTable& table, std::size_t row) {
  const auto index = find(seq_of(table, row));
  return index ? &frames_[*index].figures : nullptr;
}

std::optional<std::size_t> DriveFigures::find(std::int64_t seq) const {
  const auto place = places_.find(seq);
  if (place == places_.end()) return {};
  return place->second;
}

FrameFigures DriveFigures::frame(std::size_t index) const {
  FrameFigures figures = frames_[index].figures;
  const auto num_points = static_cast<std::ptrdiff_t>(frames_[index].num_path_points);
  figures.path_m.assign(path_m_.begin(), path_m_.begin() + num_points);
  return figures;
}

std::string object_label(const std::string& class_name, const Eigen::Vector2d& place_m) {
  return format("%s %.0f m", class_name.c_str(), place_m.norm());
}

}  // namespace plumb
