#include "modules/ground/cues/candidate_mixture.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace plumb {
namespace {

Box box_of(const Eigen::Vector4d& b) {
  return {b(0) - 0.5 * b(2), b(1) - b(3), b(0) + 0.5 * b(2), b(1)};
}

/// A Gaussian that is correlated as a detector's candidates are: a higher box is also a taller one.
MixtureComponent truth(const Eigen::Vector4d& mean, double amplitude, double size) {
  MixtureComponent result;
  result.amplitude = amplitude;
  result.mean = mean;
  Eigen::Matrix4d factor;
  factor << 1.0, 0.0, 0.0, 0.0, 0.1, 0.7, 0.0, 0.0, 0.3, 0.2, 1.2, 0.0, -0.1, 0.5, 0.3, 0.9;
  result.cov = size * size * factor * factor.transpose();
  return result;
}

double score(const MixtureComponent& m, const Eigen::Vector4d& b) {
  const Eigen::Vector4d e = b - m.mean;
  return m.amplitude * std::exp(-0.5 * e.dot(m.cov.inverse() * e));
}

/// Adds boxes that scatter about `m` a little wider than its Gaussian. Their scores are the sum
/// over all of `mixture`.
void add_samples(const std::vector<MixtureComponent>& mixture, const MixtureComponent& m, int count,
                 double noise, std::mt19937* random, CandidateMixture* fit) {
  std::normal_distribution<double> normal;
  const Eigen::Matrix4d factor = m.cov.llt().matrixL();
  for (int i = 0; i < count; ++i) {
    Eigen::Vector4d z;
    for (int k = 0; k < 4; ++k) z(k) = normal(*random);
    const Eigen::Vector4d b = m.mean + 1.2 * factor * z;
    double sum = noise * normal(*random);
    for (const MixtureComponent& other : mixture) sum += score(other, b);
    ASSERT_TRUE(fit->add_sample(box_of(b), sum));
  }
}

void expect_near(const MixtureComponent& found, const MixtureComponent& expected, double ratio) {
  EXPECT_NEAR(found.amplitude, expected.amplitude, ratio * expected.amplitude);
  const double size = std::sqrt(expected.cov.trace());
  EXPECT_LT((found.mean - expected.mean).norm(), ratio * size);
  EXPECT_LT((found.cov - expected.cov).norm(), 2.0 * ratio * expected.cov.norm());
  EXPECT_NEAR(placement_confidence_px2(found), placement_confidence_px2(expected),
              2.0 * ratio * placement_confidence_px2(expected));
}

TEST(CandidateMixture, RecoversOneGaussianFromAnOffsetStart) {
  const MixtureComponent expected = truth({600.0, 250.0, 90.0, 70.0}, 0.9, 6.0);
  std::mt19937 random(1);
  CandidateMixture fit;
  add_samples({expected}, expected, 80, 0.0, &random, &fit);
  ASSERT_TRUE(fit.add_component(box_of(expected.mean + Eigen::Vector4d(4, -3, 5, -4)), 0.7));
  ASSERT_TRUE(fit.fit(50));
  expect_near(fit.component(0), expected, 0.02);
  EXPECT_LT(fit.rms_residual(), 1e-3);
}

TEST(CandidateMixture, RecoversTwoOverlappingCarsUnderNoise) {
  const MixtureComponent near = truth({600.0, 250.0, 90.0, 70.0}, 0.95, 6.0);
  const MixtureComponent far = truth({622.0, 238.0, 70.0, 55.0}, 0.7, 5.0);
  std::mt19937 random(2);
  CandidateMixture fit;
  add_samples({near, far}, near, 64, 0.005, &random, &fit);
  add_samples({near, far}, far, 64, 0.005, &random, &fit);
  ASSERT_TRUE(fit.add_component(box_of(near.mean + Eigen::Vector4d(2, 2, -3, 1)), 0.9));
  ASSERT_TRUE(fit.add_component(box_of(far.mean + Eigen::Vector4d(-2, 1, 2, 2)), 0.8));
  ASSERT_TRUE(fit.fit(60));
  expect_near(fit.component(0), near, 0.08);
  expect_near(fit.component(1), far, 0.08);
  EXPECT_EQ(fit.nearest_component(box_of(near.mean)), 0u);
  EXPECT_EQ(fit.nearest_component(box_of(far.mean)), 1u);
}

TEST(CandidateMixture, WiderCandidatesGiveALargerConfidenceParameter) {
  std::mt19937 random(3);
  double last = 0.0;
  for (const double size : {2.0, 4.0, 8.0}) {
    const MixtureComponent expected = truth({600.0, 250.0, 90.0, 70.0}, 0.9, size);
    CandidateMixture fit;
    add_samples({expected}, expected, 40, 0.01, &random, &fit);
    ASSERT_TRUE(fit.add_component(box_of(expected.mean), 0.9));
    ASSERT_TRUE(fit.fit(30));
    const double confidence = placement_confidence_px2(fit.component(0));
    EXPECT_GT(confidence, 2.0 * last);
    last = confidence;
  }
}

TEST(CandidateMixture, StaysAtTheStartWhereTheSamplesSayNothing) {
  CandidateMixture fit;
  const Eigen::Vector4d start(600.0, 250.0, 80.0, 64.0);
  ASSERT_TRUE(fit.add_component(box_of(start), 0.8));
  ASSERT_TRUE(fit.add_sample(box_of(start), 0.8));
  ASSERT_TRUE(fit.fit(30));
  const MixtureComponent found = fit.component(0);
  EXPECT_LT((found.mean - start).norm(), 1e-6);
  EXPECT_NEAR(found.cov(1, 1), 64.0, 1e-6);   // (64 / 8)^2
  EXPECT_NEAR(found.cov(2, 2), 100.0, 1e-6);  // (80 / 8)^2
}

TEST(CandidateMixture, SixteenCandidatesOfOneDetectionAreEnough) {
  const MixtureComponent expected = truth({600.0, 250.0, 90.0, 70.0}, 0.9, 5.0);
  std::mt19937 random(4);
  double log_ratio_sum = 0.0;
  constexpr int kTrials = 20;
  for (int trial = 0; trial < kTrials; ++trial) {
    CandidateMixture fit;
    add_samples({expected}, expected, static_cast<int>(kMaxCandidates), 0.01, &random, &fit);
    ASSERT_TRUE(fit.add_component(box_of(expected.mean + Eigen::Vector4d(1, 1, -1, 1)), 0.9));
    ASSERT_TRUE(fit.fit(20));
    const double log_ratio =
        std::log(placement_confidence_px2(fit.component(0)) / placement_confidence_px2(expected));
    EXPECT_LT(std::abs(log_ratio), std::log(5.0)) << trial;
    log_ratio_sum += log_ratio;
  }
  EXPECT_LT(std::abs(log_ratio_sum / kTrials), std::log(1.5));
}

TEST(CandidateMixture, RefusesWhatItCannotHoldOrUse) {
  CandidateMixture fit;
  const Box box{10.0, 10.0, 30.0, 40.0};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(fit.add_sample({10.0, 10.0, 10.0, 40.0}, 0.5));
  EXPECT_FALSE(fit.add_sample({nan, 10.0, 20.0, 40.0}, 0.5));
  EXPECT_FALSE(fit.add_sample(box, nan));
  EXPECT_FALSE(fit.add_component({10.0, 40.0, 30.0, 10.0}, 0.5));
  for (std::size_t i = 0; i < CandidateMixture::kMaxSamples; ++i) {
    ASSERT_TRUE(fit.add_sample(box, 0.5));
  }
  EXPECT_FALSE(fit.add_sample(box, 0.5));
  for (std::size_t i = 0; i < CandidateMixture::kMaxComponents; ++i) {
    ASSERT_TRUE(fit.add_component(box, 0.5));
  }
  EXPECT_FALSE(fit.add_component(box, 0.5));
  EXPECT_TRUE(fit.fit(10));
  fit.clear();
  EXPECT_EQ(fit.num_samples(), 0u);
  EXPECT_EQ(fit.num_components(), 0u);
}

}  // namespace
}  // namespace plumb
