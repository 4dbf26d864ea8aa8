/// What the dissent of cues and fused plane is taken to be, over way and through frames without a cue.
#include "modules/ground/covariance/plane_dissent.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "modules/ground/filter/plane_filter.hpp"

namespace plumb {
namespace {

const Eigen::Vector3d kState(0.01, 0.02, 0.1);

/// A dense cue tilted by (n1, n3) from kState, travel along the fused plane, half a camera height of way.
GroundSight sight_apart(double n1, double n3) {
  GroundSight sight;
  sight.searched = true;
  sight.context = {0.01, 0.5};
  sight.dense_status = CueStatus::kUsed;
  const Eigen::Vector3d state = kState + Eigen::Vector3d(n1, n3, 0.0);
  sight.dense.q = normal_of_state(state) * std::exp(-state(2));
  const Eigen::Vector3d normal = normal_of_state(kState);
  sight.travel.direction = (Eigen::Vector3d::UnitZ() - normal.z() * normal).normalized();
  return sight;
}

TEST(PlaneDissent, IsTheSquareOfTheTiltBetweenCueAndPlane) {
  PlaneDissent dissent;
  dissent.add(sight_apart(0.002, -0.005), kState);
  EXPECT_NEAR(dissent.context().dense_n1_square, 4e-6, 1e-12);
  EXPECT_NEAR(dissent.context().dense_n3_square, 25e-6, 1e-12);
  EXPECT_NEAR(dissent.context().travel_square, 0.0, 1e-15);
  EXPECT_EQ(dissent.context().cue.turn_ratio, 0.01);
  EXPECT_EQ(dissent.context().cue.step_ratio, 0.5);
}

TEST(PlaneDissent, SeesTravelThatLeavesThePlane) {
  GroundSight sight = sight_apart(0.0, 0.0);
  sight.travel.direction = sight.travel.direction + 0.01 * normal_of_state(kState);
  sight.travel.direction.normalize();
  PlaneDissent dissent;
  dissent.add(sight, kState);
  EXPECT_NEAR(std::sqrt(dissent.context().travel_square), 0.01, 1e-5);
}

TEST(PlaneDissent, FadesOverWayNotOverFrames) {
  const auto after = [](double step_ratio, int num_frames) {
    PlaneDissent dissent;
    dissent.add(sight_apart(0.004, 0.0), kState);
    for (int i = 0; i < num_frames; ++i) {
      GroundSight sight = sight_apart(0.0, 0.0);
      sight.context.step_ratio = step_ratio;
      dissent.add(sight, kState);
    }
    return dissent.context().dense_n1_square;
  };
  EXPECT_NEAR(after(0.5, 6), after(0.1, 30), 1e-12);
  EXPECT_NEAR(after(0.5, 10) / 16e-6, std::exp(-1.0), 1e-9);
  EXPECT_NEAR(after(0.0, 50), 16e-6, 1e-12);  // a car that stands learns nothing new
}

TEST(PlaneDissent, KeepsTheMeanWhereTheCueSawNothing) {
  PlaneDissent dissent;
  dissent.add(sight_apart(0.0, 0.006), kState);
  GroundSight blind = sight_apart(0.0, 0.5);
  blind.dense_status = CueStatus::kFailed;
  dissent.add(blind, kState);
  EXPECT_NEAR(dissent.context().dense_n3_square, 36e-6, 1e-12);
  dissent.forget();
  EXPECT_EQ(dissent.context().dense_n3_square, 0.0);
  dissent.add(sight_apart(0.0, 0.001), kState);
  EXPECT_NEAR(dissent.context().dense_n3_square, 1e-6, 1e-12);
}

}  // namespace
}  // namespace plumb
