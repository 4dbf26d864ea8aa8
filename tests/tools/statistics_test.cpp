#include "tools/support/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb {
namespace {

TEST(Statistics, QuantilesLieBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(median({4, 1, 3, 2}), 2.5);
  EXPECT_DOUBLE_EQ(median({3, 1, 2}), 2.0);
}

TEST(Statistics, RobustSpreadIsDeafToOneOutlier) {
  EXPECT_NEAR(robust_std({1, 2, 3, 4, 1000}), 1.4826, 1e-12);
}

TEST(Statistics, MomentsAreThoseOfTheTextbook) {
  EXPECT_DOUBLE_EQ(mean({1, 2, 3}), 2.0);
  EXPECT_DOUBLE_EQ(standard_deviation({1, 2, 3}), 1.0);
  EXPECT_DOUBLE_EQ(rms({3, 4}), std::sqrt(12.5));
}

TEST(Statistics, NothingHasNoStatistics) {
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_TRUE(std::isnan(mean({})));
  EXPECT_TRUE(std::isnan(rms({})));
  EXPECT_DOUBLE_EQ(standard_deviation({5}), 0.0);
}

}  // namespace
}  // namespace plumb
