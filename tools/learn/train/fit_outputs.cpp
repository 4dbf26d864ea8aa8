#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "modules/ground/types/ground_types.hpp"
#include "tools/learn/train/fit.hpp"

namespace plumb {
namespace {

struct Quantity {
  const char* name;
  double Sample::*error;
  double Sample::*var;
};

constexpr Quantity kScale{"ln_scale", &Sample::out_scale_err, &Sample::out_scale_var};
constexpr Quantity kQuantities[] = {kScale,
                                    {"ln_height", &Sample::out_height_err, &Sample::out_height_var},
                                    {"pitch", &Sample::out_pitch_err, &Sample::out_pitch_var},
                                    {"roll", &Sample::out_roll_err, &Sample::out_roll_var},
                                    {"ln_step", &Sample::out_step_err, &Sample::out_step_var}};

constexpr int kBisections = 60;
constexpr double kLargestBiasStd = 0.5;

/// Noise of the true scale and step, which is not the estimate's.
double truth_var(const Quantity& q, const Sample& s) {
  if (q.error == &Sample::out_scale_err) return s.truth_ln_std * s.truth_ln_std;
  if (q.error != &Sample::out_step_err || !(s.true_step_m > 0.0)) return 0.0;
  const double jitter = s.truth_ln_std * s.chord_m / s.true_step_m;
  return jitter * jitter;
}

VarianceScore score_drive(const Quantity& q, const DriveSamples& drive) {
  ScoreSum sum;
  for (const Sample& s : drive.frames) {
    const double var = s.*q.var + truth_var(q, s);
    if (std::isfinite(s.*q.error) && std::isfinite(var) && var > 0.0) sum.add(s.*q.error, var);
  }
  return sum.mean();
}

/// Median over drives of the scale's mean normalised squared error, with that bias in place of the
/// run's; 0 without any drive.
double typical_nees(const std::vector<DriveSamples>& drives, double bias_std) {
  std::vector<double> nees;
  for (const DriveSamples& drive : drives) {
    ScoreSum sum;
    for (const Sample& s : drive.frames) {
      const double var =
          s.out_scale_var + truth_var(kScale, s) + bias_std * bias_std - s.out_scale_bias_var;
      if (std::isfinite(s.out_scale_err) && std::isfinite(var) && var > 0.0)
        sum.add(s.out_scale_err, var);
    }
    if (sum.mean().num > 0) nees.push_back(sum.mean().nees);
  }
  if (nees.empty()) return 0.0;
  const auto middle = nees.begin() + static_cast<std::ptrdiff_t>(nees.size() / 2);
  std::nth_element(nees.begin(), middle, nees.end());
  return *middle;
}

}  // namespace

void fit_scale_bias(const std::vector<DriveSamples>& drives, GroundModel* model) {
  if (drives.front().algorithm != "learned") return;
  double low = 0.0;
  double high = kLargestBiasStd;
  for (int i = 0; i < kBisections && typical_nees(drives, 0.0) > 1.0; ++i) {
    const double middle = 0.5 * (low + high);
    (typical_nees(drives, middle) > 1.0 ? low : high) = middle;
  }
  model->ln_scale_bias_std = low;
}

std::vector<OutputScore> score_outputs(const std::vector<DriveSamples>& drives) {
  std::vector<OutputScore> scores;
  for (const Quantity& q : kQuantities) {
    for (const DriveSamples& drive : drives) {
      OutputScore score{drive.drive, q.name, score_drive(q, drive), 0.0, 0.0};
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

std::vector<CueScore> score_cues(const std::vector<DriveSamples>& drives) {
  std::vector<CueScore> scores;
  for (std::size_t i = 0; i < kNumCues; ++i) {
    for (const DriveSamples& drive : drives) {
      CueScore score{drive.drive, kCueTable[i].name, 0, 0, 0.0};
      int num_tested = 0;
      for (const Sample& s : drive.frames) {
        const CueSample& cue = s.cues[i];
        score.num_used += cue.status == static_cast<double>(CueStatus::kUsed) ? 1 : 0;
        score.num_rejected += cue.status == static_cast<double>(CueStatus::kGated) ? 1 : 0;
        if (!std::isfinite(cue.test_ratio)) continue;
        score.mean_test_ratio += cue.test_ratio;
        ++num_tested;
      }
      score.mean_test_ratio = num_tested > 0 ? score.mean_test_ratio / num_tested : kNan;
      if (score.num_used + score.num_rejected > 0) scores.push_back(score);
    }
  }
  return scores;
}

}  // namespace plumb
