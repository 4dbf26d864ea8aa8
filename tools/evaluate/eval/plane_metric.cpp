#include "tools/evaluate/eval/plane_metric.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/numbers.hpp"
#include "tools/support/statistics.hpp"

namespace plumb {
namespace {

class CalibrationSum {
 public:
  void add(double error, std::optional<double> std) {
    if (std && *std > 0.0) ratios_.push_back(error / *std);
  }
  [[nodiscard]] Calibration result() const {
    if (ratios_.empty()) return {0, kNan, kNan, kNan};
    const double r = rms(ratios_);
    return {static_cast<int>(ratios_.size()), r * r, share_within(1.0), share_within(2.0)};
  }

 private:
  [[nodiscard]] double share_within(double limit) const {
    const auto inside = std::count_if(ratios_.begin(), ratios_.end(),
                                      [limit](double r) { return std::abs(r) <= limit; });
    return static_cast<double>(inside) / static_cast<double>(ratios_.size());
  }
  std::vector<double> ratios_;
};

AngleError angle_error(const std::vector<double>& errors_rad) {
  return {mean(errors_rad), standard_deviation(errors_rad), rms(errors_rad)};
}

void height_errors(const std::vector<PlanePair>& pairs, PlaneReport* report) {
  std::vector<double> signed_percent;
  std::vector<double> percent;
  double within = 0.0;
  for (const PlanePair& pair : pairs) {
    signed_percent.push_back(100.0 * (pair.height_m / pair.true_height_m - 1.0));
    percent.push_back(std::abs(signed_percent.back()));
    if (percent.back() <= 7.0) within += 1.0;
  }
  report->height_bias_percent = mean(signed_percent);
  report->height_error_mean_percent = mean(percent);
  report->height_error_median_percent = median(percent);
  report->height_error_max_percent = quantile(percent, 1.0);
  report->within_7_ratio = percent.empty() ? kNan : within / static_cast<double>(percent.size());
}

}  // namespace

PlaneReport compare_planes(const std::map<std::int64_t, TruePlane>& truth,
                           const std::vector<EstimatedPlane>& estimates) {
  PlaneReport report;
  report.num_true = static_cast<int>(truth.size());
  std::vector<double> pitch_errors_rad;
  std::vector<double> roll_errors_rad;
  CalibrationSum height, pitch, roll;
  for (const EstimatedPlane& estimate : estimates) {
    const auto found = truth.find(estimate.seq);
    if (found == truth.end()) continue;
    if (!estimate.height_m || !estimate.pitch_rad || !estimate.roll_rad) continue;
    const TruePlane& plane = found->second;
    report.pairs.push_back({estimate.seq, plane.height_m, *estimate.height_m, plane.pitch_rad(),
                            *estimate.pitch_rad, *estimate.roll_rad - plane.roll_rad()});
    if (estimate.status.empty() || estimate.status == "ok") ++report.num_ok;
    const PlanePair& pair = report.pairs.back();
    pitch_errors_rad.push_back(pair.pitch_rad - pair.true_pitch_rad);
    roll_errors_rad.push_back(pair.roll_error_rad);
    height.add(pair.height_m - pair.true_height_m, estimate.height_std_m);
    pitch.add(pitch_errors_rad.back(), estimate.pitch_std_rad);
    roll.add(roll_errors_rad.back(), estimate.roll_std_rad);
  }
  report.num_compared = static_cast<int>(report.pairs.size());
  height_errors(report.pairs, &report);
  report.pitch = angle_error(pitch_errors_rad);
  report.roll = angle_error(roll_errors_rad);
  report.height_calibration = height.result();
  report.pitch_calibration = pitch.result();
  report.roll_calibration = roll.result();
  return report;
}

}  // namespace plumb
