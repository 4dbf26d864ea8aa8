#include "modules/ground/cues/robust_mean.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <utility>

namespace plumb {
namespace {

Votes votes_of(std::initializer_list<std::pair<double, double>> values_and_stds) {
  Votes votes;
  for (const auto& [value, std] : values_and_stds) {
    EXPECT_TRUE(votes.push_back({value, std, 0.0}));
  }
  return votes;
}

TEST(RobustMean, IsTheWeightedMeanOfVotesThatAgree) {
  Votes votes = votes_of({{1.000, 0.1}, {1.001, 0.2}});
  EXPECT_NEAR(robust_mean(&votes), (1.0 * 100.0 + 1.001 * 25.0) / 125.0, 1e-6);
  EXPECT_GT(votes[0].weight, 0.999);
  EXPECT_GT(votes[1].weight, 0.999);
}

TEST(RobustMean, IsNotDraggedByAMinorityThatAgreesWithItself) {
  Votes votes = votes_of({{0.0, 0.1}, {0.05, 0.1}, {-0.04, 0.1}, {3.0, 0.1}, {3.01, 0.1}});
  EXPECT_NEAR(robust_mean(&votes), 0.0, 0.02);
  EXPECT_EQ(votes[3].weight, 0.0);
  EXPECT_EQ(votes[4].weight, 0.0);
}

TEST(RobustMean, DoesNotDependOnTheOrderOfTheVotes) {
  Votes forward = votes_of({{0.0, 0.1}, {0.3, 0.2}, {9.0, 0.1}, {0.1, 0.1}});
  Votes backward = votes_of({{0.1, 0.1}, {9.0, 0.1}, {0.3, 0.2}, {0.0, 0.1}});
  EXPECT_NEAR(robust_mean(&forward), robust_mean(&backward), 1e-12);
}

TEST(RobustMean, OfOneVoteIsThatVote) {
  Votes votes = votes_of({{0.7, 0.01}});
  EXPECT_EQ(robust_mean(&votes), 0.7);
  EXPECT_EQ(votes[0].weight, 1.0);
}

}  // namespace
}  // namespace plumb
