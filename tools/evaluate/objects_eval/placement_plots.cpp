#include <algorithm>
#include <cmath>

#include "core/input_error.hpp"
#include "tools/evaluate/eval/gnuplot.hpp"
#include "tools/evaluate/objects_eval/placement_report.hpp"
#include "tools/support/statistics.hpp"

namespace plumb {
namespace {

constexpr double kBin_m = 5.0;
constexpr std::size_t kLeastInBin = 5;

/// A curve over the true depth that has `of` the samples of every 5 m.
template <typename Of>
Curve binned(const std::string& title, const std::vector<PlacementSample>& samples, Of of) {
  double farthest_m = 0.0;
  for (const PlacementSample& sample : samples) farthest_m = std::max(farthest_m, sample.truth_m);
  Curve curve{title, {}, {}};
  for (double from_m = 0.0; from_m <= farthest_m; from_m += kBin_m) {
    std::vector<double> values;
    for (const PlacementSample& sample : samples) {
      const bool inside = sample.truth_m >= from_m && sample.truth_m < from_m + kBin_m;
      if (inside) values.push_back(of(sample));
    }
    if (values.size() < kLeastInBin) continue;
    curve.x.push_back(from_m + 0.5 * kBin_m);
    curve.y.push_back(mean(values));
  }
  return curve;
}

void square_roots(Curve* curve) {
  for (double& value : curve->y) value = std::sqrt(value);
}

Plot depth_plot(const std::vector<PlacementSample>& samples) {
  Curve truth{"truth", {}, {}}, depth{"reported", {}, {}, true};
  for (const PlacementSample& sample : samples) {
    depth.x.push_back(sample.truth_m);
    depth.y.push_back(sample.depth_m);
  }
  const double farthest_m = *std::max_element(depth.x.begin(), depth.x.end());
  truth.x = truth.y = {0.0, farthest_m};
  return {"depth of objects", "true depth [m]", "m", {truth, depth}, false, true};
}

Plot error_plot(const std::vector<PlacementSample>& samples) {
  const auto error_of = [](double PlacementSample::*depth_m) {
    return [depth_m](const PlacementSample& s) {
      return 100.0 * std::abs(s.*depth_m - s.truth_m) / s.truth_m;
    };
  };
  const Curve calibrated =
      binned("foot, calibrated", samples, error_of(&PlacementSample::foot_calibrated_m));
  const Curve foot = binned("foot, plane", samples, error_of(&PlacementSample::foot_m));
  const Curve object = binned("object", samples, error_of(&PlacementSample::depth_m));
  return {"mean depth error", "true depth [m]", "percent", {calibrated, foot, object}, false, true};
}

Plot deviation_plot(const std::vector<PlacementSample>& samples) {
  Curve error = binned("error, RMS", samples, [](const PlacementSample& s) {
    return (s.depth_m - s.truth_m) * (s.depth_m - s.truth_m);
  });
  Curve deviation = binned("reported deviation", samples,
                           [](const PlacementSample& s) { return s.depth_std_m * s.depth_std_m; });
  square_roots(&error);
  square_roots(&deviation);
  return {"depth error and its reported deviation",
          "true depth [m]",
          "m",
          {error, deviation},
          false,
          true};
}

}  // namespace

std::vector<std::filesystem::path> draw_placement(const std::vector<DrivePlacement>& drives,
                                                  const std::filesystem::path& folder,
                                                  const std::string& format) {
  const std::vector<PlacementSample> samples = pool(drives).samples;
  if (samples.empty()) return {};
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError("cannot make folder " + folder.string() + ": " + error.message());
  const std::filesystem::path file = folder / ("placed." + format);
  draw({depth_plot(samples), error_plot(samples), deviation_plot(samples)}, file);
  return {file};
}

}  // namespace plumb
