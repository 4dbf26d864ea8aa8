#include "tools/evaluate/objects_eval/placement_report.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"
#include "tools/evaluate/objects_eval/label_choice.hpp"
#include "tools/support/statistics.hpp"

namespace plumb {
namespace {

constexpr double kStanding_m_s =
    1.0;  ///< labels and poses of a real parked car wander by half of it

bool counts(const PlacementSample& sample, Range range, Motion motion) {
  if ((sample.truth_m <= kClose_m) != (range == Range::kClose)) return false;
  if (motion == Motion::kAny) return true;
  if (!std::isfinite(sample.speed_m_s)) return false;
  return (sample.speed_m_s < kStanding_m_s) == (motion == Motion::kStanding);
}

const char* name_of(Range range) { return range == Range::kClose ? "close" : "distant"; }
const char* name_of(Motion motion) {
  return motion == Motion::kAny ? "all" : motion == Motion::kStanding ? "standing" : "moving";
}

constexpr Range kRanges[] = {Range::kClose, Range::kDistant};
constexpr Motion kMotions[] = {Motion::kAny, Motion::kStanding, Motion::kMoving};

constexpr const char* kTableHead =
    R"(error in % of the true depth; close: up to 10 m, standing: below 1 m/s; NEES: squared error over variance
                                            |  depth of the object |   in space    |      NEES      | foot point, depth
drive                range   motion       n |  mean median    bias |  mean median | depth position | plane calibrated
)";

std::string rows_of(const DrivePlacement& drive) {
  std::string text;
  for (const Range range : kRanges) {
    for (const Motion motion : kMotions) {
      const PlacementFigures f = placement_figures(drive.samples, range, motion);
      if (f.num_samples == 0) {
        if (motion == Motion::kAny)
          text += format("%-20s %-8snone\n", drive.name.c_str(), name_of(range));
        continue;
      }
      text += format("%-20s %-8s%-9s%5zu |%6.2f%7.2f%+8.2f |%6.2f%7.2f |%6.2f%9.2f |%6.1f%11.1f\n",
                     drive.name.c_str(), name_of(range), name_of(motion), f.num_samples,
                     f.depth_mean_percent, f.depth_median_percent, f.depth_bias_percent,
                     f.position_mean_percent, f.position_median_percent, f.depth_nees,
                     f.position_nees, f.foot_percent, f.foot_calibrated_percent);
    }
  }
  return text;
}

/// null where there is nothing to say.
nlohmann::json json_number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json json_of(const PlacementFigures& f) {
  return {{"num_samples", f.num_samples},
          {"depth_error_percent", json_number(f.depth_mean_percent)},
          {"depth_error_median_percent", json_number(f.depth_median_percent)},
          {"depth_bias_percent", json_number(f.depth_bias_percent)},
          {"position_error_percent", json_number(f.position_mean_percent)},
          {"position_error_median_percent", json_number(f.position_median_percent)},
          {"depth_nees", json_number(f.depth_nees)},
          {"position_nees", json_number(f.position_nees)},
          {"foot_depth_error_percent", json_number(f.foot_percent)},
          {"foot_calibrated_depth_error_percent", json_number(f.foot_calibrated_percent)}};
}

nlohmann::json json_of(const DrivePlacement& drive) {
  nlohmann::json json{
      {"name", drive.name}, {"num_labels", drive.num_labels}, {"num_placed", drive.samples.size()}};
  for (const Range range : kRanges) {
    for (const Motion motion : kMotions) {
      json[name_of(range)][name_of(motion)] =
          json_of(placement_figures(drive.samples, range, motion));
    }
  }
  return json;
}

}  // namespace

PlacementFigures placement_figures(const std::vector<PlacementSample>& samples, Range range,
                                   Motion motion) {
  std::vector<double> depth, bias, position, depth_nees, position_nees, foot, foot_calibrated;
  for (const PlacementSample& sample : samples) {
    if (!counts(sample, range, motion)) continue;
    const auto percent = [&](double z_m) {
      return 100.0 * (z_m - sample.truth_m) / sample.truth_m;
    };
    bias.push_back(percent(sample.depth_m));
    depth.push_back(std::abs(bias.back()));
    position.push_back(100.0 * sample.position_error_m / sample.truth_m);
    depth_nees.push_back(sample.depth_nees);
    position_nees.push_back(sample.position_nees);
    foot.push_back(std::abs(percent(sample.foot_m)));
    foot_calibrated.push_back(std::abs(percent(sample.foot_calibrated_m)));
  }
  return {depth.size(),   mean(depth),          median(depth),    mean(bias),
          mean(position), median(position),     mean(depth_nees), mean(position_nees),
          mean(foot),     mean(foot_calibrated)};
}

DrivePlacement pool(const std::vector<DrivePlacement>& drives) {
  DrivePlacement all;
  all.name = "all";
  for (const DrivePlacement& drive : drives) {
    all.num_labels += drive.num_labels;
    all.samples.insert(all.samples.end(), drive.samples.begin(), drive.samples.end());
  }
  return all;
}

std::string placement_table(const std::vector<DrivePlacement>& drives) {
  std::string text = kTableHead;
  for (const DrivePlacement& drive : drives) text += rows_of(drive);
  const DrivePlacement all = pool(drives);
  if (drives.size() > 1) text += rows_of(all);
  return text + format("%zu of %zu labels have a place\n", all.samples.size(), all.num_labels);
}

void write_placement_json(const std::vector<DrivePlacement>& drives,
                          const std::filesystem::path& path) {
  nlohmann::json json{{"all", json_of(pool(drives))}, {"drives", nlohmann::json::array()}};
  for (const DrivePlacement& drive : drives) json["drives"].push_back(json_of(drive));
  std::ofstream file(path);
  file << json.dump(2) << "\n";
  if (!file.flush()) throw InputError("cannot write " + path.string());
}

}  // namespace plumb
