#include <algorithm>
#include <cmath>

#include "tools/train/fit.hpp"

namespace plumb {
namespace {

struct Quantity {
  const char* name;
  double Sample::*error;
  double Sample::*var;
  double Sample::*bias_var;  ///< null: has none
  double PlaneBias::*bias;
};

constexpr Quantity kQuantities[] = {
    {"ln_scale", &Sample::out_scale_err, &Sample::out_scale_var, &Sample::out_scale_bias_var,
     &PlaneBias::ln_scale_std},
    {"ln_height", &Sample::out_height_err, &Sample::out_height_var, &Sample::out_height_bias_var,
     &PlaneBias::ln_height_std},
    {"pitch", &Sample::out_pitch_err, &Sample::out_pitch_var, &Sample::out_pitch_bias_var,
     &PlaneBias::pitch_std_rad},
    {"roll", &Sample::out_roll_err, &Sample::out_roll_var, &Sample::out_roll_bias_var,
     &PlaneBias::roll_std_rad},
    {"ln_step", &Sample::out_step_err, &Sample::out_step_var, nullptr, nullptr}};

constexpr int kBisections = 60;
constexpr double kLargestBiasStd = 0.5;

/// Noise of the true scale and step: not the estimate's.
double truth_var(const Quantity& q, const Sample& s) {
  if (q.error == &Sample::out_scale_err) return s.truth_ln_std * s.truth_ln_std;
  if (q.error != &Sample::out_step_err || !(s.true_step_m > 0.0)) return 0.0;
  const double jitter = s.truth_ln_std * s.chord_m / s.true_step_m;
  return jitter * jitter;
}

VarianceScore score_drive(const Quantity& q, const DriveSamples& drive, double bias_std,
                          bool replace_bias) {
  ScoreSum sum;
  for (const Sample& s : drive.frames) {
    double var = s.*q.var + truth_var(q, s);
    if (replace_bias) {
      if (!std::isfinite(s.*q.bias_var)) continue;
      var += bias_std * bias_std - s.*q.bias_var;
    }
    if (std::isfinite(s.*q.error) && std::isfinite(var) && var > 0.0) sum.add(s.*q.error, var);
  }
  return sum.mean();
}

/// Median over drives of the mean squared ratio with that bias in place of the run's; 0 without any drive.
double typical_nees(const Quantity& q, const std::vector<DriveSamples>& drives, double bias_std) {
  std::vector<double> nees;
  for (const DriveSamples& drive : drives) {
    const VarianceScore score = score_drive(q, drive, bias_std, true);
    if (score.num > 0) nees.push_back(score.nees);
  }
  if (nees.empty()) return 0.0;
  const auto middle = nees.begin() + static_cast<std::ptrdiff_t>(nees.size() / 2);
  std::nth_element(nees.begin(), middle, nees.end());
  return *middle;
}

}  // namespace

void fit_bias(const std::vector<DriveSamples>& drives, GroundModel* model) {
  if (drives.front().algorithm != "learned") return;
  for (const Quantity& q : kQuantities) {
    if (q.bias == nullptr) continue;
    double low = 0.0;
    double high = kLargestBiasStd;
    for (int i = 0; i < kBisections && typical_nees(q, drives, 0.0) > 1.0; ++i) {
      const double middle = 0.5 * (low + high);
      (typical_nees(q, drives, middle) > 1.0 ? low : high) = middle;
    }
    model->bias.*q.bias = low;
  }
}

std::vector<OutputScore> score_outputs(const std::vector<DriveSamples>& drives) {
  std::vector<OutputScore> scores;
  for (const Quantity& q : kQuantities) {
    for (const DriveSamples& drive : drives) {
      OutputScore score{drive.drive, q.name, score_drive(q, drive, 0.0, false), 0.0, 0.0};
      if (score.score.num == 0) continue;
      double num = 0.0, error2 = 0.0, var = 0.0;
      for (const Sample& s : drive.frames) {
        if (!std::isfinite(s.*q.error) || !std::isfinite(s.*q.var)) continue;
        num += 1.0;
        error2 += s.*q.error * s.*q.error;
        var += s.*q.var;
      }
      score.rms_error = std::sqrt(error2 / num);
      score.mean_std = std::sqrt(var / num);
      scores.push_back(score);
    }
  }
  return scores;
}

}  // namespace plumb
