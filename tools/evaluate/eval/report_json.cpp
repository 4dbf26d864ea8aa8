#include "tools/evaluate/eval/report_json.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/input_error.hpp"
#include "core/numbers.hpp"

namespace plumb {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const MeanError& error) {
  return {{"num_segments", error.num_segments},
          {"t_percent", error.t_percent},
          {"r_deg_m", error.r_deg_m}};
}

Json to_json(const std::vector<BinError>& bins, const char* at) {
  Json list = Json::array();
  for (const BinError& bin : bins) {
    Json entry = {{at, bin.at}};
    entry.update(to_json(bin.error));
    list.push_back(entry);
  }
  return list;
}

Json to_json(const MetricSummary& summary) {
  Json json = to_json(summary.all);
  json["by_length"] = to_json(summary.by_length, "length_m");
  json["by_speed"] = to_json(summary.by_speed, "speed_m_s");
  return json;
}

Json to_json(const RatioStatistics& ratio) {
  return {{"num", ratio.num},
          {"median", ratio.median},
          {"spread", ratio.spread},
          {"quantile_05", ratio.low},
          {"quantile_95", ratio.high}};
}

Json to_json(const SequenceReport& sequence) {
  Json json = {
      {"name", sequence.name}, {"num_frames", sequence.gt.size()}, {"path_m", sequence.path_m}};
  json.update(to_json(sequence.summary));
  json["scale_steps"] = to_json(sequence.scale.steps);
  json["scale_windows"] = to_json(sequence.scale.windows);
  json["scale_windows"]["window_m"] = sequence.scale.window_m;
  return json;
}

Json to_json(const AngleError& error) {
  return {{"mean_deg", degrees(error.mean_rad)},
          {"std_deg", degrees(error.std_rad)},
          {"rms_deg", degrees(error.rms_rad)}};
}

Json to_json(const Calibration& calibration) {
  return {{"num", calibration.num},
          {"nees", calibration.nees},
          {"within_1_sigma", calibration.within_1_sigma},
          {"within_2_sigma", calibration.within_2_sigma}};
}

void write(const Json& json, const std::filesystem::path& path) {
  std::ofstream file(path);
  file << json.dump(2) << "\n";
  file.close();
  if (!file) throw InputError("cannot write " + path.string());
}

}  // namespace

void write_json(const TrajectoryReport& report, const std::filesystem::path& path) {
  Json json = {{"pooled", to_json(report.pooled)},
               {"mean_of_sequences", to_json(report.mean_of_sequences)},
               {"sequences", Json::array()}};
  for (const SequenceReport& sequence : report.sequences) {
    json["sequences"].push_back(to_json(sequence));
  }
  write(json, path);
}

void write_json(const PlaneReport& report, const std::filesystem::path& path) {
  write({{"num_true", report.num_true},
         {"num_compared", report.num_compared},
         {"num_ok", report.num_ok},
         {"height_error_mean_percent", report.height_error_mean_percent},
         {"height_error_median_percent", report.height_error_median_percent},
         {"height_error_max_percent", report.height_error_max_percent},
         {"height_bias_percent", report.height_bias_percent},
         {"within_7_percent_ratio", report.within_7_ratio},
         {"pitch", to_json(report.pitch)},
         {"roll", to_json(report.roll)},
         {"height_calibration", to_json(report.height_calibration)},
         {"pitch_calibration", to_json(report.pitch_calibration)},
         {"roll_calibration", to_json(report.roll_calibration)}},
        path);
}

}  // namespace plumb
