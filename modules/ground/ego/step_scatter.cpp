#include "modules/ground/ego/step_scatter.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

constexpr double kLeastFactor = 0.25;
constexpr double kMostFactor = 16.0;
// A speed that differs by more than this many standard deviations has an error of its own.
constexpr double kMostStds = 2.0;
// One image counts as no more than this many times the mean.
constexpr double kMostOfOneImage = 16.0;

}  // namespace

double StepScatter::factor(double difference_m_s, double expected_var, double stated_var,
                           double dt_s) {
  const double difference2 = square(difference_m_s);
  const double least_var = difference2 / square(kMostStds) - expected_var;
  const double result = std::max(mean_factor_, least_var / stated_var);
  const double seen =
      std::clamp((difference2 - expected_var) / stated_var, 0.0, kMostOfOneImage * mean_factor_);
  const double share = 1.0 - std::exp(-dt_s / config_.scatter_memory_s);
  mean_factor_ =
      std::clamp(mean_factor_ + share * (seen - mean_factor_), kLeastFactor, kMostFactor);
  return result;
}

}  // namespace plumb
