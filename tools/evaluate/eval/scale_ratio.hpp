/// Ratios of estimated to true lengths of motion: the scale error alone, without rotation.
#pragma once

#include <vector>

#include "modules/datasets/kitti/pose_file.hpp"

namespace plumb {

/// Statistics of |estimated| / |true|. Without anything to compare, all but the count are NaN.
struct RatioStatistics {
  int num = 0;
  double median = 0.0;
  double spread = 0.0;  ///< robust 1-sigma
  double low = 0.0;     ///< 5 % quantile
  double high = 0.0;    ///< 95 % quantile
};

struct ScaleRatio {
  RatioStatistics steps;    ///< from frame to frame, where the true step is longer than 0.3 m
  RatioStatistics windows;  ///< straight from the first to the last frame of windows of true path
  double window_m = 0.0;
};

/// Windows begin at every frame that lies `window_m` further along than the last window's, and do
/// not overlap.
/// @pre gt.size() == est.size(), window_m > 0
[[nodiscard]] ScaleRatio scale_ratio(const std::vector<PoseMatrix>& gt,
                                     const std::vector<PoseMatrix>& est, double window_m);

}  // namespace plumb
