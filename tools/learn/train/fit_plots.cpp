#include <algorithm>
#include <cmath>

#include "core/input_error.hpp"
#include "tools/evaluate/eval/gnuplot.hpp"
#include "tools/learn/train/fit_report.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

constexpr int kPlotBins = 20;

/// |error| over the predicted 1-sigma, and the root mean square in bins of equal count beside the
/// line y = x.
Plot calibration_plot(Target target, const std::vector<DriveSamples>& drives,
                      const GroundModel& model) {
  std::vector<Confidence> confidences;
  for (const DriveSamples& drive : drives) {
    for (const TargetRow& row : rows_of(target, drive, model)) {
      const double var = model_of(target, model).of(row.row.features) + row.row.extra_var;
      confidences.push_back({std::sqrt(var), row.row.error});
    }
  }
  Curve marks{"|error|", {}, {}, true}, line{"error = 1-sigma", {}, {}, false};
  Curve binned{"rms of bins", {}, {}, false};
  double most = 0.0;
  for (const Confidence& b : confidences) {
    marks.x.push_back(b.confidence);
    marks.y.push_back(std::min(std::abs(b.error), 4.0 * b.confidence));
    most = std::max(most, b.confidence);
  }
  for (const ConfidenceBin& bin : bin_confidences(confidences, kPlotBins)) {
    binned.x.push_back(bin.centre);
    binned.y.push_back(std::sqrt(bin.variance));
  }
  line.x = {0.0, most};
  line.y = {0.0, most};
  return {std::string(target_name(target)) + ": errors against predicted standard deviations",
          "predicted 1-sigma",
          "|error| (drawn up to 4 sigma)",
          {marks, binned, line},
          false,
          true};
}

Plot confidence_plot(const ConfidenceFit& fit) {
  Curve bins{"bins of equal count", {}, {}, true}, line{"line", {}, {}, false};
  for (const ConfidenceBin& bin : fit.bins) {
    bins.x.push_back(bin.centre);
    bins.y.push_back(bin.variance);
    line.x.push_back(bin.centre);
    line.y.push_back(fit.line.of(bin.centre));
  }
  return {std::string(fit.name) + ": error variance by confidence",
          "confidence",
          "mean squared error",
          {bins, line},
          false,
          true};
}

}  // namespace

std::vector<fs::path> draw_fit(const std::vector<DriveSamples>& drives, const FitReport& report,
                               const fs::path& folder, const std::string& format) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError("cannot make folder " + folder.string() + ": " + error.message());
  std::vector<fs::path> files;
  for (const Target target : kTargets) {
    const Plot plot = calibration_plot(target, drives, report.models.ground);
    if (plot.curves.front().x.empty()) continue;
    files.push_back(folder / (std::string(target_name(target)) + "." + format));
    draw({plot}, files.back());
  }
  std::vector<Plot> confidences;
  for (const ConfidenceFit& fit : report.paper) confidences.push_back(confidence_plot(fit));
  if (!confidences.empty()) {
    files.push_back(folder / ("paper_confidences." + format));
    draw(confidences, files.back());
  }
  if (report.objects) {
    files.push_back(folder / ("objects_confidence." + format));
    draw({confidence_plot(*report.objects)}, files.back());
  }
  return files;
}

}  // namespace plumb
