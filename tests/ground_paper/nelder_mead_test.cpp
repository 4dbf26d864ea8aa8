#include "modules/ground_paper/nelder_mead.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace plumb {
namespace {

using Point2 = Eigen::Vector2d;
using Point3 = Eigen::Vector3d;

TEST(NelderMead, FindsTheBottomOfAStretchedBowl) {
  const Point3 bottom(1.3, -0.02, 0.05);
  const auto cost = [&](const Point3& x) {
    const Point3 d = x - bottom;
    return 2.0 + d(0) * d(0) + 100.0 * d(1) * d(1) + 900.0 * d(2) * d(2) + 5.0 * d(0) * d(2);
  };
  NelderMead<3, decltype(cost)> search(cost, {500, 1e-12, 1e-4});
  const auto found = search.run(Point3(1.0, 0.0, 0.0), Point3(0.1, 0.02, 0.02));
  EXPECT_TRUE(found.converged);
  EXPECT_LT((found.x - bottom).norm(), 1e-4);
  EXPECT_NEAR(found.value, 2.0, 1e-9);
}

TEST(NelderMead, FollowsTheBananaValleyOfRosenbrock) {
  const auto cost = [](const Point2& x) {
    const double a = 1.0 - x(0), b = x(1) - x(0) * x(0);
    return a * a + 100.0 * b * b;
  };
  NelderMead<2, decltype(cost)> search(cost, {1000, 1e-12, 1e-5});
  const auto found = search.run(Point2(-1.2, 1.0), Point2(0.5, 0.5));
  EXPECT_LT((found.x - Point2(1.0, 1.0)).norm(), 1e-4);
}

TEST(NelderMead, WalksAroundWhereTheCostDoesNotExist) {
  const auto cost = [](const Point2& x) {
    if (x(0) < 0.0) return std::numeric_limits<double>::quiet_NaN();
    return (x - Point2(0.01, 2.0)).squaredNorm();
  };
  NelderMead<2, decltype(cost)> search(cost, {500, 1e-12, 1e-4});
  const auto found = search.run(Point2(1.0, 0.0), Point2(0.3, 0.3));
  EXPECT_LT((found.x - Point2(0.01, 2.0)).norm(), 1e-3);
}

TEST(NelderMead, StopsAtItsLimitAndSaysSo) {
  int num_calls = 0;
  const auto cost = [&](const Point2& x) {
    ++num_calls;
    return x.squaredNorm();
  };
  NelderMead<2, decltype(cost)> search(cost, {20, 1e-30, 1e-30});
  const auto found = search.run(Point2(3.0, 4.0), Point2(0.5, 0.5));
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(found.num_evaluations, num_calls);
  EXPECT_LE(num_calls, 20 + 4);  // the last move may shrink
  EXPECT_LT(found.value, 25.0);
}

}  // namespace
}  // namespace plumb
