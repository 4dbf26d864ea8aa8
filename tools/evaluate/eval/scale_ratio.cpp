#include "tools/evaluate/eval/scale_ratio.hpp"

#include "tools/evaluate/eval/kitti_metric.hpp"
#include "tools/support/statistics.hpp"

namespace plumb {
namespace {

// Below this the truth's own noise (1-2 cm a step) is more than a few per cent.
constexpr double kMinTrueStep_m = 0.3;

double chord_m(const std::vector<PoseMatrix>& poses, std::size_t first, std::size_t last) {
  return (poses[last] - poses[first]).topRightCorner<3, 1>().norm();
}

RatioStatistics statistics_of(const std::vector<double>& ratios) {
  return {static_cast<int>(ratios.size()), median(ratios), robust_std(ratios),
          quantile(ratios, 0.05), quantile(ratios, 0.95)};
}

}  // namespace

ScaleRatio scale_ratio(const std::vector<PoseMatrix>& gt, const std::vector<PoseMatrix>& est,
                       double window_m) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < gt.size(); ++i) {
    const double true_m = chord_m(gt, i - 1, i);
    if (true_m > kMinTrueStep_m) steps.push_back(chord_m(est, i - 1, i) / true_m);
  }
  std::vector<double> windows;
  const std::vector<float> path_m = path_lengths_m(gt);
  int first = 0;
  int last = gt.empty() ? -1 : last_frame_of_segment(path_m, 0, window_m);
  while (last >= 0) {
    const auto a = static_cast<std::size_t>(first);
    const auto b = static_cast<std::size_t>(last);
    // A loop inside one window has no chord to measure.
    const double true_m = chord_m(gt, a, b);
    if (true_m > 0.5 * window_m) windows.push_back(chord_m(est, a, b) / true_m);
    first = last;
    last = last_frame_of_segment(path_m, first, window_m);
  }
  return {statistics_of(steps), statistics_of(windows), window_m};
}

}  // namespace plumb
