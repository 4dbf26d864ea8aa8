#include "modules/vo/two_view.hpp"

#include <gtest/gtest.h>

#include <random>

namespace plumb::vo {
namespace {

constexpr double kFocalPx = 720.0;

struct Views {
  Se3 T_second_first;
  std::vector<RayPair> pairs;
  std::vector<double> rho;
};

/// Makes points 4 to 60 units away that both views see. A share of `outliers` is moved at random.
Views make_views(const Se3& T_second_first, int count, double noise_px, double outliers) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, 1.0);
  Views views{T_second_first, {}, {}};
  while (static_cast<int>(views.pairs.size()) < count) {
    const double z = 4.0 + 56.0 * unit(generator);
    const Eigen::Vector2d xy(1.6 * unit(generator) - 0.8, 0.5 * unit(generator) - 0.25);
    const Eigen::Vector3d p = T_second_first * (z * xy.homogeneous());
    if (p.z() < 1.0) continue;
    Eigen::Vector2d second = p.head<2>() / p.z();
    second += Eigen::Vector2d(normal(generator), normal(generator)) * (noise_px / kFocalPx);
    if (unit(generator) < outliers) {
      second += Eigen::Vector2d(unit(generator) - 0.5, unit(generator) - 0.5) * 0.1;
    }
    views.pairs.push_back({xy, second});
    views.rho.push_back(1.0 / z);
  }
  return views;
}

Se3 forward() { return {exp_so3({0.004, -0.02, 0.003}), {0.03, -0.02, -1.2}}; }
Se3 sideways() { return {exp_so3({0.01, 0.05, -0.02}), {-0.8, 0.1, 0.05}}; }

double rotation_error(const Se3& a, const Se3& b) { return log_so3(a.R.transpose() * b.R).norm(); }

TEST(FivePoint, OneOfTheSolutionsIsExact) {
  for (const Se3& T : {forward(), sideways()}) {
    const Views views = make_views(T, 5, 0.0, 0.0);
    EssentialSolutions solutions;
    solve_five_point(
        {views.pairs[0], views.pairs[1], views.pairs[2], views.pairs[3], views.pairs[4]},
        &solutions);
    const Eigen::Matrix3d truth = (hat(T.t) * T.R).normalized();
    double best = 1.0;
    for (const Eigen::Matrix3d& E : solutions) {
      best = std::min({best, (E - truth).norm(), (E + truth).norm()});
    }
    EXPECT_LT(best, 1e-7);
  }
}

TEST(TwoView, RecoversExactMotionFromExactPoints) {
  for (const Se3& T : {forward(), sideways()}) {
    const Views views = make_views(T, 120, 0.0, 0.0);
    Random random(1);
    const TwoView found = solve_two_view(views.pairs, kFocalPx, Se3{}, random);
    ASSERT_TRUE(found.ok);
    EXPECT_LT(rotation_error(found.T_second_first, T), 1e-8);
    EXPECT_LT((found.T_second_first.t - T.t.normalized()).norm(), 1e-7);
    EXPECT_EQ(found.num_inliers, 120);
  }
}

TEST(TwoView, SurvivesNoiseAndAThirdOfOutliers) {
  const Views views = make_views(forward(), 250, 0.2, 0.33);
  Random random(1);
  const TwoView found = solve_two_view(views.pairs, kFocalPx, Se3{}, random);
  ASSERT_TRUE(found.ok);
  EXPECT_LT(rotation_error(found.T_second_first, forward()), 0.002);
  EXPECT_LT((found.T_second_first.t - forward().t.normalized()).norm(), 0.02);
}

TEST(TwoView, TheSameSeedGivesTheSameResult) {
  const Views views = make_views(forward(), 150, 0.3, 0.2);
  Random a(5);
  Random b(5);
  const TwoView first = solve_two_view(views.pairs, kFocalPx, Se3{}, a);
  const TwoView second = solve_two_view(views.pairs, kFocalPx, Se3{}, b);
  EXPECT_EQ(first.T_second_first.R, second.T_second_first.R);
  EXPECT_EQ(first.T_second_first.t, second.T_second_first.t);
}

TEST(TwoView, RefusesTooFewPairs) {
  const Views views = make_views(forward(), 12, 0.0, 0.0);
  Random random(1);
  EXPECT_FALSE(solve_two_view(views.pairs, kFocalPx, Se3{}, random).ok);
}

TEST(Triangulate, GivesTheInverseDepthInTheFirstView) {
  const Views views = make_views(forward(), 50, 0.0, 0.0);
  for (std::size_t i = 0; i < views.pairs.size(); ++i) {
    double rho = 0.0;
    ASSERT_TRUE(triangulate(views.pairs[i], views.T_second_first, &rho));
    EXPECT_NEAR(rho, views.rho[i], 1e-9);
  }
}

TEST(RotationFit, ExplainsATurnAndLeavesParallax) {
  std::vector<double> scratch;
  const Se3 turn{exp_so3({0.01, -0.06, 0.02}), Eigen::Vector3d::Zero()};
  const RotationFit pure = fit_rotation(make_views(turn, 100, 0.0, 0.0).pairs, kFocalPx, scratch);
  EXPECT_LT(log_so3(pure.R_second_first.transpose() * turn.R).norm(), 1e-9);
  EXPECT_LT(pure.median_px, 1e-6);
  const RotationFit moved =
      fit_rotation(make_views(sideways(), 100, 0.0, 0.0).pairs, kFocalPx, scratch);
  EXPECT_GT(moved.median_px, 5.0);
}

}  // namespace
}  // namespace plumb::vo
