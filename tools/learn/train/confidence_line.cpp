#include "tools/learn/train/confidence_line.hpp"

#include <algorithm>

#include "tools/support/statistics.hpp"

namespace plumb {
namespace {

// Bounds of the line's values: confidences beyond those of training say nothing more.
constexpr double kLowQuantile = 0.02;
constexpr double kHighQuantile = 0.98;

}  // namespace

std::vector<ConfidenceBin> bin_confidences(std::vector<Confidence> confidences, int num_bins) {
  std::sort(confidences.begin(), confidences.end(), [](const Confidence& a, const Confidence& b) {
    return a.confidence < b.confidence || (a.confidence == b.confidence && a.error < b.error);
  });
  const std::size_t n = confidences.size();
  const std::size_t bins = std::min<std::size_t>(static_cast<std::size_t>(num_bins), n / 2);
  std::vector<ConfidenceBin> result;
  for (std::size_t i = 0; i < bins; ++i) {
    ConfidenceBin bin;
    for (std::size_t k = i * n / bins; k < (i + 1) * n / bins; ++k) {
      bin.centre += confidences[k].confidence;
      bin.variance += confidences[k].error * confidences[k].error;
      ++bin.num;
    }
    bin.centre /= bin.num;
    bin.variance /= bin.num;
    result.push_back(bin);
  }
  return result;
}

LinearVariance fit_line(const std::vector<ConfidenceBin>& bins) {
  double num = 0.0, sum_x = 0.0, sum_y = 0.0;
  for (const ConfidenceBin& bin : bins) {
    num += bin.num;
    sum_x += bin.num * bin.centre;
    sum_y += bin.num * bin.variance;
  }
  const double mean_x = sum_x / num;
  LinearVariance line;
  line.mean = sum_y / num;
  double xx = 0.0, xy = 0.0;
  for (const ConfidenceBin& bin : bins) {
    xx += bin.num * (bin.centre - mean_x) * (bin.centre - mean_x);
    xy += bin.num * (bin.centre - mean_x) * (bin.variance - line.mean);
  }
  line.slope = xx > 0.0 ? xy / xx : 0.0;
  line.offset = line.mean - line.slope * mean_x;
  std::vector<double> fitted;
  for (const ConfidenceBin& bin : bins) fitted.push_back(line.offset + line.slope * bin.centre);
  // A steep line may cross zero; a tenth of the mean is the least that an error scatters.
  const double floor = 0.1 * line.mean;
  line.least = std::max(floor, quantile(fitted, kLowQuantile));
  line.most = std::max(line.least, quantile(fitted, kHighQuantile));
  return line;
}

}  // namespace plumb
