#include "tools/learn/train/variance_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numbers.hpp"

namespace plumb {
namespace {

constexpr int kNumParams = 1 + static_cast<int>(kNumCueFeatures);
using Params = Eigen::Matrix<double, kNumParams, 1>;
using ParamMatrix = Eigen::Matrix<double, kNumParams, kNumParams>;

constexpr int kIterations = 60;
constexpr double kEnough = 1e-7;
constexpr double kLargestStep = 1.0;
constexpr double kClip = 9.0;    // e^2 / V beyond which a row's influence is bounded: three sigma
constexpr double kFixed = 1e12;  // precision of a slope that stays
constexpr double kFreePrecision = 1e-6;
constexpr double kSmallestVar = 1e-14;

Params features_of(const VarianceRow& row) {
  Params f;
  f(0) = 1.0;
  for (std::size_t i = 0; i < kNumCueFeatures; ++i) f(1 + static_cast<int>(i)) = row.features[i];
  return f;
}

/// Robust start value: the rows' weighted mean square without their extra variance.
double start_ln_var(const std::vector<VarianceRow>& rows) {
  double sum = 0.0;
  double weight = 0.0;
  for (const VarianceRow& row : rows) {
    sum += row.weight * std::max(kSmallestVar, row.error * row.error - row.extra_var);
    weight += row.weight;
  }
  return std::log(sum / weight);
}

}  // namespace

LogVariance fit_log_variance(const std::vector<VarianceRow>& rows, const SlopePrior& prior,
                             const VarianceBounds& bounds) {
  Params theta = Params::Zero();
  Params mean = Params::Zero();
  Params precision = Params::Constant(kFreePrecision);
  for (std::size_t i = 0; i < kNumCueFeatures; ++i) {
    const int k = 1 + static_cast<int>(i);
    theta(k) = mean(k) = prior.mean[i];
    precision(k) = prior.std[i] > 0.0 ? 1.0 / (prior.std[i] * prior.std[i]) : kFixed;
  }
  theta(0) = mean(0) = start_ln_var(rows);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    // Fisher scoring: d ln V / d theta = u f with u the cue's share of V.
    ParamMatrix H = precision.asDiagonal();
    Params b = precision.cwiseProduct(mean - theta);
    for (const VarianceRow& row : rows) {
      const Params f = features_of(row);
      const double cue_var = std::exp(std::min(theta.dot(f), 20.0)) + kSmallestVar;
      const double var = cue_var + row.extra_var;
      const double u = cue_var / var;
      const double z = std::min(row.error * row.error / var, kClip);
      b += 0.5 * row.weight * u * (z - 1.0) * f;
      H += 0.5 * row.weight * u * u * f * f.transpose();
    }
    Params step = H.ldlt().solve(b);
    if (step.cwiseAbs().maxCoeff() > kLargestStep)
      step *= kLargestStep / step.cwiseAbs().maxCoeff();
    const Params before = theta;
    theta += step;
    theta.tail<kNumParams - 1>() = theta.tail<kNumParams - 1>().cwiseMax(0.0);
    if ((theta - before).cwiseAbs().maxCoeff() < kEnough) break;
  }
  LogVariance model;
  model.ln_var = theta(0);
  for (std::size_t i = 0; i < kNumCueFeatures; ++i)
    model.slopes[i] = theta(1 + static_cast<int>(i));
  model.low_std = bounds.low_std;
  model.high_std = bounds.high_std;
  return model;
}

void ScoreSum::add(double error, double var) {
  const double z = error * error / var;
  ++sum_.num;
  sum_.nees += z;
  sum_.log_likelihood -= 0.5 * (std::log(2.0 * std::numbers::pi * var) + z);
}

VarianceScore ScoreSum::mean() const {
  if (sum_.num == 0) return {0, kNan, kNan};
  return {sum_.num, sum_.nees / sum_.num, sum_.log_likelihood / sum_.num};
}

}  // namespace plumb
