#include "modules/objects/box_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/objects/cuboid_scene.hpp"

namespace plumb {
namespace {

using test::car_at;
using test::kSceneCamera;

constexpr Contact kNoInset{};

MeasuredBox measured(const StateVector& state, const RoadPlane& plane, double std_px) {
  MeasuredBox box;
  box.edges_px = project_cuboid(kSceneCamera, plane, state, 0.0)->edges_px;
  box.var_px2.setConstant(std_px * std_px);
  return box;
}

/// A prior that knows the sizes to a tenth and carries no information on the position.
StateEstimate vague(const StateVector& about) {
  StateEstimate prior;
  prior.x = about;
  prior.P.diagonal() << 200.0, 200.0, 100.0, 100.0, 0.05, 0.01, 0.01, 0.01, 1e-8;
  return prior;
}

TEST(BoxFit, AnUnknownInsetWidensTheDistance) {
  const RoadPlane plane = test::road(0.0);
  const StateVector truth = car_at(9.0, 2.0, 0.0);
  const MeasuredBox box = measured(truth, plane, 0.5);
  const auto sure = fit_box(kSceneCamera, plane, kNoInset, box, vague(truth));
  const auto unsure = fit_box(kSceneCamera, plane, {0.0, 0.2}, box, vague(truth));
  EXPECT_GT(unsure.estimate.P(kX, kX), 1.2 * sure.estimate.P(kX, kX));
}

TEST(BoxFit, FindsThePlaceOfACarOfKnownSize) {
  const RoadPlane plane = test::road(0.004, 0.01);
  for (const double x_m : {8.0, 20.0, 45.0}) {
    const StateVector truth = car_at(x_m, 2.5, 0.0);
    StateVector guess = truth;
    guess(kX) *= 1.3;
    guess(kY) += 1.0;
    const auto fit =
        fit_box(kSceneCamera, plane, kNoInset, measured(truth, plane, 0.5), vague(guess));
    ASSERT_TRUE(fit.ok);
    EXPECT_NEAR(fit.estimate.x(kX), x_m, 0.01 * x_m);
    EXPECT_NEAR(fit.estimate.x(kY), 2.5, 0.15);
    EXPECT_LT(fit.estimate.P(kX, kX), 0.1 * x_m);
  }
}

TEST(BoxFit, PosteriorIsSmallerThanThePriorAndPositive) {
  const RoadPlane plane = test::road(0.0);
  const StateVector truth = car_at(25.0, -3.0, 0.2);
  const StateEstimate prior = vague(truth);
  const auto fit = fit_box(kSceneCamera, plane, kNoInset, measured(truth, plane, 1.0), prior);
  ASSERT_TRUE(fit.ok);
  const Eigen::SelfAdjointEigenSolver<StateMatrix> posterior(fit.estimate.P);
  const Eigen::SelfAdjointEigenSolver<StateMatrix> gained(prior.P - fit.estimate.P);
  EXPECT_GT(posterior.eigenvalues().minCoeff(), -1e-9);
  EXPECT_GT(gained.eigenvalues().minCoeff(), -1e-9);
}

TEST(BoxFit, UncertainPlaneMakesAFarPlaceUncertain) {
  const RoadPlane sure = test::road(0.0);
  const StateVector truth = car_at(50.0, 0.0, 0.0);
  StateEstimate prior = vague(truth);
  prior.P(kLogHeight, kLogHeight) = prior.P(kLogWidth, kLogWidth) = 0.25;
  const auto box = measured(truth, sure, 0.3);
  const double known = fit_box(kSceneCamera, sure, kNoInset, box, prior).estimate.P(kX, kX);
  prior.P(kPlaneError, kPlaneError) = 1e-4;
  const double unknown = fit_box(kSceneCamera, sure, kNoInset, box, prior).estimate.P(kX, kX);
  EXPECT_GT(unknown, 4.0 * known);
}

TEST(BoxFit, OneWrongEdgeLosesItsSay) {
  const RoadPlane plane = test::road(0.0);
  const StateVector truth = car_at(20.0, 0.0, 0.0);
  StateEstimate prior = vague(truth);
  prior.P.diagonal().segment<3>(kLogWidth).setConstant(1e-4);
  prior.P.diagonal().head<2>().setConstant(1.0);  // as in an established track
  MeasuredBox box = measured(truth, plane, 1.0);
  box.edges_px(3) -= 25.0;  // the lower half is hidden, but the detector does not say so
  const auto fit = fit_box(kSceneCamera, plane, kNoInset, box, prior);
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.estimate.x(kX), 20.0, 1.5);
  EXPECT_GT(fit.chi2, 30.0);
}

TEST(BoxFit, ACutEdgeCountsOnlyAgainstSolutionsInsideTheImage) {
  const RoadPlane plane = test::road(0.0);
  const StateVector truth = car_at(7.0, -4.5, 0.0);
  MeasuredBox box = measured(truth, plane, 0.5);
  ASSERT_GT(box.edges_px(2), 1241.0);
  box.edges_px(2) = 1241.0;
  box.cut[2] = true;
  const auto fit = fit_box(kSceneCamera, plane, kNoInset, box, vague(truth));
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.estimate.x(kX), 7.0, 0.3);
  EXPECT_NEAR(fit.estimate.x(kY), -4.5, 0.3);
  // When the image does not cut the box, the same edge contradicts the object.
  box.cut[2] = false;
  EXPECT_GT(fit_box(kSceneCamera, plane, kNoInset, box, vague(truth)).chi2, 10.0 * fit.chi2 + 1.0);
}

TEST(BoxFit, RefusesAnObjectThatCannotBeSeenFromHere) {
  const RoadPlane plane = test::road(0.0);
  const auto box = measured(car_at(20.0, 0.0, 0.0), plane, 1.0);
  EXPECT_FALSE(fit_box(kSceneCamera, plane, kNoInset, box, vague(car_at(-5.0, 0.0, 0.0))).ok);
}

}  // namespace
}  // namespace plumb
