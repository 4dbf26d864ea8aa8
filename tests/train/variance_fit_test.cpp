/// Tests whether the variance fit finds the model from which samples were drawn, despite outliers
/// and known extra noise.
#include "tools/learn/train/variance_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/train/drawn.hpp"

namespace plumb {
namespace {

const SlopePrior kFreePrior{{0.0, 0.0, 0.0, 0.0}, {10.0, 10.0, 10.0, 10.0}};
const VarianceBounds kWide{1e-5, 10.0};

TEST(VarianceFit, FindsTheModelThatSamplesWereDrawnFrom) {
  const LogVariance truth{-7.0, {0.5, 3.0, 1.5, 0.8}, 1e-5, 10.0};
  const auto rows = test::draw_rows(truth, 4000, 1, 0.0, 0.0);
  const LogVariance fit = fit_log_variance(rows, kFreePrior, kWide);
  EXPECT_NEAR(fit.ln_var, truth.ln_var, 0.12);
  for (std::size_t i = 0; i < kNumCueFeatures; ++i)
    EXPECT_NEAR(fit.slopes[i], truth.slopes[i], 0.3);
}

TEST(VarianceFit, TakesKnownExtraNoiseOff) {
  const LogVariance truth{-7.0, {0.0, 0.0, 1.0, 0.0}, 1e-5, 10.0};
  const auto rows = test::draw_rows(truth, 4000, 2, std::exp(-6.5), 0.0);
  const LogVariance fit = fit_log_variance(rows, kFreePrior, kWide);
  EXPECT_NEAR(fit.ln_var, truth.ln_var, 0.25);
  EXPECT_NEAR(fit.slopes[2], 1.0, 0.25);
}

TEST(VarianceFit, IsNotLedAstrayByAFewOutliers) {
  const LogVariance truth{-7.0, {0.0, 0.0, 0.0, 0.0}, 1e-5, 10.0};
  const auto rows = test::draw_rows(truth, 2000, 3, 0.0, 0.02);
  const LogVariance fit = fit_log_variance(rows, kFreePrior, kWide);
  EXPECT_NEAR(fit.ln_var, truth.ln_var, 0.35);  // the plain mean square is off by 3.7
}

TEST(VarianceFit, KeepsThePriorWhereSamplesSayNothing) {
  std::vector<VarianceRow> rows;
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal(0.0, 0.03);
  for (int i = 0; i < 200; ++i) rows.push_back({normal(random), 0.0, 1.0, {0.0, 0.0, 0.0, 0.0}});
  const SlopePrior prior{{0.3, 4.0, 1.5, 0.5}, {0.3, 1.0, 0.7, 0.0}};
  const LogVariance fit = fit_log_variance(rows, prior, kWide);
  EXPECT_NEAR(fit.slopes[1], 4.0, 1e-3);
  EXPECT_NEAR(fit.slopes[3], 0.5, 1e-6);
  EXPECT_NEAR(fit.ln_var, 2.0 * std::log(0.03), 0.3);
}

TEST(VarianceFit, NeverMakesAFeatureAnAdvantage) {
  const LogVariance truth{-7.0, {0.0, 0.0, -1.0, 0.0}, 1e-5, 10.0};
  const LogVariance fit =
      fit_log_variance(test::draw_rows(truth, 1000, 5, 0.0, 0.0), kFreePrior, kWide);
  EXPECT_EQ(fit.slopes[2], 0.0);
}

TEST(VarianceScore, IsTheMeanOfSquaredRatiosAndLogLikelihoods) {
  ScoreSum sum;
  EXPECT_EQ(sum.mean().num, 0);
  EXPECT_TRUE(std::isnan(sum.mean().nees));
  sum.add(2.0, 4.0);
  sum.add(3.0, 1.0);
  EXPECT_EQ(sum.mean().num, 2);
  EXPECT_DOUBLE_EQ(sum.mean().nees, (1.0 + 9.0) / 2.0);
  const double first = -0.5 * (std::log(2.0 * M_PI * 4.0) + 1.0);
  const double second = -0.5 * (std::log(2.0 * M_PI) + 9.0);
  EXPECT_NEAR(sum.mean().log_likelihood, 0.5 * (first + second), 1e-12);
}

}  // namespace
}  // namespace plumb
