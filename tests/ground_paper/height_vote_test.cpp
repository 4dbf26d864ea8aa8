#include "modules/ground_paper/height_vote.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace plumb {
namespace {

constexpr double kMu = 50.0;

TEST(HeightVote, ScoresAsEquationEight) {
  const std::vector<double> heights{1.6, 1.7, 2.0};
  const HeightVote vote = vote_height(heights, kMu);
  ASSERT_TRUE(vote.ok);
  EXPECT_EQ(vote.height, 1.7);
  EXPECT_NEAR(vote.score, std::exp(-50.0 * 0.1 * 0.1) + std::exp(-50.0 * 0.3 * 0.3), 1e-12);
}

TEST(HeightVote, WinsAgainstMoreOutliersThatDisagree) {
  std::mt19937 random(3);
  std::normal_distribution<double> road(1.65, 0.03);
  std::uniform_real_distribution<double> rubbish(-3.0, 6.0);
  std::vector<double> heights;
  for (int i = 0; i < 60; ++i) heights.push_back(rubbish(random));
  for (int i = 0; i < 40; ++i) heights.push_back(road(random));
  const HeightVote vote = vote_height(heights, kMu);
  ASSERT_TRUE(vote.ok);
  EXPECT_NEAR(vote.height, 1.65, 0.04);
  EXPECT_GT(vote.score, 25.0);
}

TEST(HeightVote, NeedsTwoVoters) {
  EXPECT_FALSE(vote_height({}, kMu).ok);
  const std::vector<double> one{1.6};
  EXPECT_FALSE(vote_height(one, kMu).ok);
  EXPECT_FALSE(vote_height_any_unit(one, kMu, 1.65).ok);
}

TEST(HeightVote, GivesTheSameWinnerInAnyUnitOfLength) {
  std::mt19937 random(5);
  std::normal_distribution<double> road(1.65, 0.04);
  std::uniform_real_distribution<double> rubbish(-2.0, 5.0);
  std::vector<double> heights;
  for (int i = 0; i < 50; ++i) heights.push_back(i % 3 == 0 ? rubbish(random) : road(random));
  const HeightVote metric = vote_height_any_unit(heights, kMu, 1.65);
  std::vector<double> scaled = heights;
  for (double& h : scaled) h *= 0.37;
  const HeightVote other = vote_height_any_unit(scaled, kMu, 1.65);
  ASSERT_TRUE(metric.ok && other.ok);
  EXPECT_NEAR(metric.height, 1.65, 0.06);
  EXPECT_NEAR(other.height, 0.37 * metric.height, 1e-12);
  EXPECT_NEAR(other.score, metric.score, 1e-9);
}

}  // namespace
}  // namespace plumb
