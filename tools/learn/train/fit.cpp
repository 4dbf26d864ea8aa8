#include "tools/learn/train/fit.hpp"

#include <algorithm>
#include <cmath>

#include "modules/ground/covariance/learned_covariance.hpp"
#include "tools/learn/train/bend_fit.hpp"

namespace plumb {
namespace {

// Correlations are summed over this many frames, which is about the filter's own memory.
constexpr int kMostLag = 15;
constexpr std::size_t kFewestRows = 20;
constexpr double kMostHeldOutNees = 10.0;  // a drive that failed counts no more than this

std::vector<std::vector<TargetRow>> rows_per_drive(Target target,
                                                   const std::vector<DriveSamples>& drives,
                                                   const GroundModel& model) {
  std::vector<std::vector<TargetRow>> rows;
  for (const DriveSamples& drive : drives) rows.push_back(rows_of(target, drive, model));
  return rows;
}

std::vector<VarianceRow> all_rows(const std::vector<std::vector<TargetRow>>& drives) {
  std::vector<VarianceRow> rows;
  for (const auto& drive : drives)
    for (const TargetRow& row : drive) rows.push_back(row.row);
  return rows;
}

double mean_step_ratio(const std::vector<std::vector<TargetRow>>& drives) {
  double sum = 0.0;
  double num = 0.0;
  for (const auto& drive : drives) {
    for (const TargetRow& row : drive) {
      sum += row.step_ratio;
      num += 1.0;
    }
  }
  return sum / num;
}

double* correlation_length_in(Target target, GroundModel* model) {
  switch (target) {
    case Target::kDenseHeight:
      return &model->dense_correlation_length_ratio;
    case Target::kPoints:
      return &model->points_correlation_length_ratio;
    default:
      return nullptr;
  }
}

/// Drives differ from each other more than the frames within them. On a drive that a fit did not
/// see, its variances are too small by this factor: the mean over held-out drives of the normalised
/// squared error.
double held_out_factor(Target target, const std::vector<std::vector<TargetRow>>& drives) {
  double sum = 0.0;
  int num = 0;
  for (std::size_t held = 0; held < drives.size(); ++held) {
    std::vector<std::vector<TargetRow>> others = drives;
    others[held].clear();
    const std::vector<VarianceRow> rows = all_rows(others);
    if (rows.size() < kFewestRows || drives[held].empty()) continue;
    const LogVariance model = fit_log_variance(rows, prior_of(target), bounds_of(target));
    ScoreSum score;
    for (const TargetRow& row : drives[held])
      score.add(row.row.error, model.of(row.row.features) + row.row.extra_var);
    sum += std::min(score.mean().nees, kMostHeldOutNees);
    ++num;
  }
  return num > 1 ? std::max(1.0, sum / num) : 1.0;
}

}  // namespace

double correlated_images_of(const std::vector<std::vector<TimedError>>& drives) {
  const auto bounded = [](const TimedError& e) { return std::clamp(e.sigmas, -3.0, 3.0); };
  double square = 0.0;
  double product = 0.0;
  for (const auto& drive : drives) {
    for (std::size_t i = 0; i < drive.size(); ++i) {
      const double z = bounded(drive[i]);
      square += z * z;
      for (std::size_t k = i + 1; k < drive.size() && drive[k].seq - drive[i].seq <= kMostLag; ++k)
        product += 2.0 * z * bounded(drive[k]);
    }
  }
  return square > 0.0 ? std::max(1.0, 1.0 + product / square) : 1.0;
}

double correlated_images_in(const std::vector<std::vector<TargetRow>>& drives,
                            const LogVariance& model) {
  std::vector<std::vector<TimedError>> errors(drives.size());
  for (std::size_t i = 0; i < drives.size(); ++i) {
    for (const TargetRow& row : drives[i]) {
      const double var = model.of(row.row.features) + row.row.extra_var;
      errors[i].push_back({row.seq, row.row.error / std::sqrt(var)});
    }
  }
  return correlated_images_of(errors);
}

double correlation_length_of(double num_images, double step_ratio) {
  // num_images = coth(step / (2 length))
  if (num_images <= 1.0 + 1e-6) return 0.0;
  return 0.5 * step_ratio / std::atanh(1.0 / num_images);
}

GroundModel fit_targets(const std::vector<DriveSamples>& drives, const GroundModel& start,
                        std::span<const Target> targets) {
  GroundModel model = start;
  // The bend comes first, because the cues' rows of drives without true planes use it.
  if (std::find(targets.begin(), targets.end(), Target::kChord) != targets.end())
    model.bend = fit_bend(drives).value_or(start.bend);
  for (const Target target : targets) {
    const auto rows = rows_per_drive(target, drives, model);
    const std::vector<VarianceRow> all = all_rows(rows);
    if (all.size() < kFewestRows) continue;
    LogVariance& cue = model_of(target, &model);
    cue = fit_log_variance(all, prior_of(target), bounds_of(target));
    cue.ln_var += std::log(held_out_factor(target, rows));
    if (double* length = correlation_length_in(target, &model))
      *length = correlation_length_of(correlated_images_in(rows, cue), mean_step_ratio(rows));
  }
  return model;
}

std::vector<HeldOutScore> leave_one_out(const std::vector<DriveSamples>& drives,
                                        const GroundModel& start, std::span<const Target> targets) {
  std::vector<HeldOutScore> scores;
  for (std::size_t held = 0; held < drives.size(); ++held) {
    std::vector<DriveSamples> others = drives;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(held));
    const GroundModel model = fit_targets(others, start, targets);
    for (const Target target : targets) {
      ScoreSum learned, hand;
      for (const TargetRow& row : rows_of(target, drives[held], model)) {
        const double extra = row.row.extra_var;
        learned.add(row.row.error, model_of(target, model).of(row.row.features) + extra);
        hand.add(row.row.error, row.hand_var + extra);
      }
      if (learned.mean().num > 0)
        scores.push_back({drives[held].drive, target, learned.mean(), hand.mean()});
    }
  }
  return scores;
}

std::vector<ConfidenceFit> fit_paper(const std::vector<DriveSamples>& drives, PaperModel* model) {
  struct Line {
    const char* name;
    double Sample::*confidence;
    double Sample::*error;
    LinearVariance* line;
  };
  const Line lines[] = {
      {"h", &Sample::paper_width_height, &Sample::paper_err_height, &model->dense_h},
      {"n1", &Sample::paper_width_n1, &Sample::paper_err_n1, &model->dense_n1},
      {"n3", &Sample::paper_width_n3, &Sample::paper_err_n3, &model->dense_n3},
      {"points h", &Sample::paper_vote, &Sample::paper_err_points, &model->points_h}};
  std::vector<ConfidenceFit> fits;
  for (const Line& line : lines) {
    std::vector<Confidence> confidences;
    for (const DriveSamples& drive : drives) {
      for (const Sample& s : drive.frames) {
        const Confidence confidence{s.*line.confidence, s.*line.error};
        if (std::isfinite(confidence.confidence) && std::isfinite(confidence.error))
          confidences.push_back(confidence);
      }
    }
    ConfidenceFit fit{line.name, bin_confidences(std::move(confidences), kNumConfidenceBins), {}};
    if (fit.bins.size() < 2) continue;
    fit.line = *line.line = fit_line(fit.bins);
    fits.push_back(std::move(fit));
  }
  return fits;
}

std::optional<ConfidenceFit> fit_paper_objects(const std::vector<BoxSample>& boxes,
                                               PaperModel* model) {
  std::vector<Confidence> confidences;
  for (const BoxSample& box : boxes) {
    if (std::isfinite(box.confidence_px2) && std::isfinite(box.error_n3))
      confidences.push_back({box.confidence_px2, box.error_n3});
  }
  ConfidenceFit fit{"objects n3", bin_confidences(std::move(confidences), kNumConfidenceBins), {}};
  if (fit.bins.size() < 2) return std::nullopt;
  fit.line = model->objects_n3 = fit_line(fit.bins);
  return fit;
}

std::optional<ConfidenceFit> fit_objects(const std::vector<DriveSamples>& drives,
                                         GroundModel* model) {
  const auto seen = [](const Sample& s) { return std::isfinite(s.objects_err_n3); };
  std::vector<Confidence> confidences;
  for (const DriveSamples& drive : drives) {
    for (const Sample& s : drive.frames)
      if (seen(s)) confidences.push_back({s.objects_confidence, s.objects_err_n3});
  }
  if (confidences.size() < kFewestRows) return std::nullopt;
  ConfidenceFit fit{"objects n3", bin_confidences(std::move(confidences), kNumConfidenceBins), {}};
  fit.line = model->objects_n3 = fit_line(fit.bins);
  std::vector<std::vector<TimedError>> errors;
  for (const DriveSamples& drive : drives) {
    errors.emplace_back();
    for (const Sample& s : drive.frames) {
      if (seen(s))
        errors.back().push_back(
            {s.seq, s.objects_err_n3 / std::sqrt(fit.line.of(s.objects_confidence))});
    }
  }
  model->objects_correlated_images = correlated_images_of(errors);
  return fit;
}

}  // namespace plumb
