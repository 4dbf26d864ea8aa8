#include "tools/datasets/kitti_tracking/kitti_tracking.hpp"

#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "core/input_error.hpp"
#include "core/numbers.hpp"
#include "modules/datasets/number_file.hpp"

namespace plumb {
namespace {

constexpr std::size_t kLeastColumns = 10;
constexpr std::size_t kColumns3d = 17;
constexpr std::int64_t kFramePeriod_us = 100'000;
constexpr double kScoreOfLabels = 1.0;
// In the order of ObjectClass.
constexpr const char* kKittiNames[kNumObjectClasses] = {"Misc", "Car",        "Van",    "Truck",
                                                        "Bus",  "Pedestrian", "Cyclist"};

double number(const std::vector<std::string_view>& words, std::size_t column,
              const std::string& at) {
  const std::optional<double> value = parse_number(words[column]);
  if (value) return *value;
  throw InputError(at + "column " + std::to_string(column + 1) + ": '" +
                   std::string(words[column]) + "' is not a finite number");
}

/// Labels state 0, 1 or 2 for how far they are cut; trackers write -1 for unknown.
double truncated_ratio(double level) { return level < 0.0 ? kNan : 0.5 * level; }

Occlusion occlusion_of(double level) {
  return level >= 0.0 && level <= 2.0 ? static_cast<Occlusion>(static_cast<int>(level))
                                      : Occlusion::kUnknown;
}

TrackingRow parse_row(const std::vector<std::string_view>& words, const std::string& at) {
  TrackingRow row;
  const auto value = [&](std::size_t column) { return number(words, column, at); };
  row.frame = static_cast<int>(value(0));
  row.detection.track_id = static_cast<std::int32_t>(value(1));
  row.detection.object_class = object_class_of(words[2]);
  row.detection.truncated_ratio = truncated_ratio(value(3));
  row.detection.occluded = occlusion_of(value(4));
  row.detection.box = {value(6), value(7), value(8), value(9)};
  row.detection.score = kScoreOfLabels;
  if (words.size() < kColumns3d) return row;
  row.size_m = {value(12), value(11), value(10)};
  row.foot_cam0 = {value(13), value(14), value(15)};
  row.rotation_y_rad = value(16);
  row.has_box3d = row.size_m.minCoeff() > 0.0 && row.foot_cam0.z() > 0.0;
  return row;
}

}  // namespace

ObjectClass object_class_of(std::string_view name) {
  if (name == "Person" || name == "Person_sitting") return ObjectClass::kPedestrian;
  for (std::size_t i = 1; i < kNumObjectClasses; ++i) {
    if (name == kKittiNames[i]) return static_cast<ObjectClass>(i);
  }
  return ObjectClass::kUnknown;
}

const char* kitti_name_of(ObjectClass object_class) {
  return kKittiNames[static_cast<std::size_t>(object_class)];
}

std::vector<TrackingRow> read_tracking(const std::filesystem::path& path) {
  std::vector<TrackingRow> rows;
  std::set<std::pair<int, int>> seen;
  int line = 0;
  for (const std::string& text : read_lines(path)) {
    ++line;
    const std::vector<std::string_view> words = split_words(text);
    if (words.empty() || (words.size() > 2 && words[2] == "DontCare")) continue;
    const std::string at = path.string() + ":" + std::to_string(line) + ": ";
    if (words.size() < kLeastColumns) {
      throw InputError(at + std::to_string(words.size()) + " columns, expected 10 or more");
    }
    const TrackingRow row = parse_row(words, at);
    if (!seen.emplace(row.frame, row.detection.track_id).second) {
      throw InputError(at + "object " + std::to_string(row.detection.track_id) +
                       " has two boxes in frame " + std::to_string(row.frame));
    }
    const Box& box = row.detection.box;
    if (box.width_px() > 0.0 && box.height_px() > 0.0) rows.push_back(row);
  }
  return rows;
}

TrackingCamera read_tracking_camera(const std::filesystem::path& path) {
  for (const std::string& text : read_lines(path)) {
    const std::vector<std::string_view> words = split_words(text);
    if (words.size() != 13 || words[0] != "P2:") continue;
    Eigen::Matrix<double, 3, 4> P;
    for (int i = 0; i < 12; ++i) {
      P(i / 4, i % 4) = number(words, static_cast<std::size_t>(i) + 1, path.string() + ": P2: ");
    }
    TrackingCamera camera;
    camera.model = {1242, 375, P(0, 0), P(1, 1), P(0, 2), P(1, 2), 0.0, 0.0, 0.0};
    const double t_z = P(2, 3);
    camera.t_cam_cam0 = {(P(0, 3) - P(0, 2) * t_z) / P(0, 0), (P(1, 3) - P(1, 2) * t_z) / P(1, 1),
                         t_z};
    return camera;
  }
  throw InputError(path.string() + ": no line P2: with 12 numbers");
}

DetectionFrame detections_of_frame(const std::vector<TrackingRow>& rows, int frame) {
  DetectionFrame result;
  result.capture_us = frame * kFramePeriod_us;
  result.seq = frame;
  for (const TrackingRow& row : rows) {
    if (row.frame == frame && !result.detections.push_back(row.detection)) break;
  }
  return result;
}

}  // namespace plumb
