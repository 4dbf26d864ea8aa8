/// The weight of a new value in a running mean.
#pragma once

#include <algorithm>

namespace plumb::vo {

/// Weight of a value that follows `num_before` others, `dt_s` after the last one, in a mean over
/// about `time_s`. The first values have equal weights.
[[nodiscard]] inline double weight_of_new(double dt_s, double time_s, int num_before) {
  return std::max(std::min(1.0, dt_s / time_s), 1.0 / (1.0 + num_before));
}

}  // namespace plumb::vo
