#include "core/percentile.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

TEST(Percentile, IsTheValueBelowWhichTheShareLies) {
  std::vector<double> values{5.0, 1.0, 4.0, 2.0, 3.0};
  EXPECT_EQ(percentile(values, 0.0), 1.0);
  EXPECT_EQ(percentile(values, 0.5), 3.0);
  EXPECT_EQ(percentile(values, 0.8), 4.0);
  EXPECT_EQ(percentile(values, 1.0), 5.0);
}

TEST(Percentile, TheUpperMedianTakesTheUpperOfTwoMiddleValues) {
  std::vector<double> odd{3.0, 1.0, 2.0};
  EXPECT_EQ(upper_median(odd), 2.0);
  std::vector<double> even{4.0, 1.0, 3.0, 2.0};
  EXPECT_EQ(upper_median(even), 3.0);
}

}  // namespace
}  // namespace plumb
