#include "tools/evaluate/eval/report_text.hpp"

#include <cmath>

#include "core/numbers.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

/// A cell of width 9; "-" stands for a missing value.
std::string cell(double value, int decimals) {
  return std::isfinite(value) ? format("%9.*f", decimals, value) : format("%9s", "-");
}

std::string error_cells(const MeanError& error) {
  return format("%9d ", error.num_segments) + cell(error.t_percent, 3) + " " +
         cell(error.r_deg_m, 5);
}

std::string ratio_line(const char* name, const RatioStatistics& ratio) {
  return format("  %-22s %6d ", name, ratio.num) + cell(ratio.median, 4) + cell(ratio.spread, 4) +
         cell(ratio.low, 4) + cell(ratio.high, 4) + "\n";
}

std::string bins(const MetricSummary& summary) {
  std::string text = "  length     segments     t [%]  r [deg/m]\n";
  for (const BinError& bin : summary.by_length) {
    text += format("  %5g m   ", bin.at) + error_cells(bin.error) + "\n";
  }
  if (summary.by_speed.empty()) return text;
  text += "  speed      segments     t [%]  r [deg/m]   (bins of +-2 m/s overlap)\n";
  for (const BinError& bin : summary.by_speed) {
    text += format("  %5g m/s ", bin.at) + error_cells(bin.error) + "\n";
  }
  return text;
}

std::string sequence_text(const SequenceReport& sequence) {
  std::string text = format("%s: %zu frames, %.1f m\n", sequence.name.c_str(), sequence.gt.size(),
                            sequence.path_m);
  text += bins(sequence.summary);
  text += "  length est / true         n    median   spread      5 %     95 %\n";
  text += ratio_line("steps above 0.3 m", sequence.scale.steps);
  text += ratio_line(format("windows of %g m", sequence.scale.window_m).c_str(),
                     sequence.scale.windows);
  return text + "\n";
}

std::string angle_line(const char* name, const AngleError& error) {
  return format("  %-10s", name) + cell(degrees(error.mean_rad), 3) +
         cell(degrees(error.std_rad), 3) + cell(degrees(error.rms_rad), 3) + "\n";
}

std::string calibration_line(const char* name, const Calibration& calibration) {
  return format("  %-10s%9d", name, calibration.num) + cell(calibration.nees, 2) +
         cell(100.0 * calibration.within_1_sigma, 1) + cell(100.0 * calibration.within_2_sigma, 1) +
         "\n";
}

}  // namespace

std::string to_text(const TrajectoryReport& report) {
  std::string text;
  for (const SequenceReport& sequence : report.sequences) text += sequence_text(sequence);
  text += "sequence                   frames   path [m]  segments     t [%]  r [deg/m]\n";
  for (const SequenceReport& sequence : report.sequences) {
    text +=
        format("%-25s %7zu %10.1f ", sequence.name.c_str(), sequence.gt.size(), sequence.path_m) +
        error_cells(sequence.summary.all) + "\n";
  }
  const std::string gap(45, ' ');
  text += ("pooled over all segments" + gap).substr(0, 45) + error_cells(report.pooled.all) + "\n";
  if (report.sequences.size() < 2) return text;
  text += ("mean of the sequences" + gap).substr(0, 45) + format("%9s ", "") +
          cell(report.mean_of_sequences.t_percent, 3) + " " +
          cell(report.mean_of_sequences.r_deg_m, 5) + "\n\nAll sequences pooled\n" +
          bins(report.pooled);
  return text;
}

std::string to_text(const PlaneReport& report) {
  std::string text = format("planes: %d true, %d compared, %d of them measured in their frame\n",
                            report.num_true, report.num_compared, report.num_ok);
  text += "  height error [%]    mean   median      max     bias  frames within 7 % [%]\n";
  text += "                 " + cell(report.height_error_mean_percent, 2) +
          cell(report.height_error_median_percent, 2) + cell(report.height_error_max_percent, 2) +
          cell(report.height_bias_percent, 2) + cell(100.0 * report.within_7_ratio, 1) + "\n";
  text += "  [deg]          mean       sd      RMS\n";
  text += angle_line("pitch", report.pitch) + angle_line("roll", report.roll);
  text +=
      "  error / stated deviation: frames, NEES (1 is right), within 1 sigma (68 %), 2 (95 %)\n";
  text += calibration_line("height", report.height_calibration) +
          calibration_line("pitch", report.pitch_calibration) +
          calibration_line("roll", report.roll_calibration);
  return text;
}

}  // namespace plumb
