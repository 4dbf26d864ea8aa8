#include "modules/objects/cuboid.hpp"

#include <gtest/gtest.h>

#include "tests/objects/cuboid_scene.hpp"
#include "tests/support/central_difference.hpp"

namespace plumb {
namespace {

using test::car_at;

TEST(Cuboid, IsTheWorkedExampleOfACarStraightAhead) {
  CameraModel camera = test::kSceneCamera;
  const RoadPlane plane = test::road(0.0);
  const auto seen = project_cuboid(camera, plane, car_at(20.0, 0.0, 0.0), 0.0);
  ASSERT_TRUE(seen.has_value());
  const double rear_m = 20.0 - 0.5 * 1.67 * 2.4;
  EXPECT_NEAR(seen->edges_px(0), camera.cx_px - 721.5 * 0.5 * 1.67 / rear_m, 1e-9);
  EXPECT_NEAR(seen->edges_px(2), camera.cx_px + 721.5 * 0.5 * 1.67 / rear_m, 1e-9);
  EXPECT_NEAR(seen->edges_px(3), camera.cy_px + 721.5 * 1.65 / rear_m, 1e-9);
  // The roof is below the camera, so its far edge is the upper one in the image.
  const double front_m = 20.0 + 0.5 * 1.67 * 2.4;
  EXPECT_NEAR(seen->edges_px(1), camera.cy_px + 721.5 * (1.65 - 1.53) / front_m, 1e-9);
}

TEST(Cuboid, LeftOnTheRoadIsLeftInTheImageAndAQuarterTurnShowsTheSide) {
  const RoadPlane plane = test::road(0.0);
  const auto left = project_cuboid(test::kSceneCamera, plane, car_at(20.0, 4.0, 0.0), 0.0);
  EXPECT_LT(left->edges_px(2), test::kSceneCamera.cx_px);
  const auto along = project_cuboid(test::kSceneCamera, plane, car_at(20.0, 0.0, 0.0), 0.0);
  const auto across = project_cuboid(test::kSceneCamera, plane, car_at(20.0, 0.0, 1.5707963), 0.0);
  EXPECT_GT(across->edges_px(2) - across->edges_px(0),
            2.0 * (along->edges_px(2) - along->edges_px(0)));
}

TEST(Cuboid, TheContactInsetMovesOnlyTheLowerEdge) {
  const RoadPlane plane = test::road(0.0);
  const auto sharp = project_cuboid(test::kSceneCamera, plane, car_at(15.0, 2.0, 0.1), 0.0);
  const auto inset = project_cuboid(test::kSceneCamera, plane, car_at(15.0, 2.0, 0.1), 0.2);
  EXPECT_EQ(sharp->edges_px.head<3>(), inset->edges_px.head<3>());
  EXPECT_LT(inset->edges_px(3), sharp->edges_px(3) - 1.0);
}

TEST(Cuboid, DerivativesAgreeWithDifferences) {
  CameraModel camera = test::kSceneCamera;
  for (const double k1 : {0.0, 0.01}) {
    camera.residual_k1 = k1;
    for (const double yaw : {-2.0, 0.3, 1.2}) {
      for (const double roll : {0.0, 0.02}) {
        StateVector state = car_at(14.0, 3.0, yaw);
        state(kPlaneError) = 0.004;
        const RoadPlane plane = test::road(-0.01, roll);
        const auto seen = project_cuboid(camera, plane, state, 0.2);
        ASSERT_TRUE(seen.has_value());
        const auto by_state = [&](const StateVector& x) {
          return project_cuboid(camera, plane, x, 0.2)->edges_px;
        };
        const auto by_plane = [&](const Eigen::Vector3d& p) {
          RoadPlane moved = plane;
          moved.pitch_rad = p.x();
          moved.roll_rad = p.y();
          moved.height_m = std::exp(p.z());
          return project_cuboid(camera, moved, state, 0.2)->edges_px;
        };
        const auto J_state = test::central_difference<4, kStateSize>(by_state, state, 1e-6);
        const auto J_plane = test::central_difference<4, 3>(
            by_plane, Eigen::Vector3d(-0.01, roll, std::log(1.65)), 1e-6);
        EXPECT_LT((J_state - seen->J_state).norm(), 1e-5 * seen->J_state.norm());
        EXPECT_LT((J_plane - seen->J_plane).norm(), 1e-5 * seen->J_plane.norm());
        const Eigen::Vector4d by_inset =
            (project_cuboid(camera, plane, state, 0.2 + 1e-6)->edges_px -
             project_cuboid(camera, plane, state, 0.2 - 1e-6)->edges_px) /
            2e-6;
        EXPECT_LT((by_inset - seen->J_inset).norm(), 1e-5 * seen->J_inset.norm());
      }
    }
  }
}

TEST(Cuboid, IsNotSeenWhenACornerLiesBesideOrBehindTheCamera) {
  EXPECT_FALSE(
      project_cuboid(test::kSceneCamera, test::road(0.0), car_at(1.5, 0.0, 0.0), 0.0).has_value());
}

}  // namespace
}  // namespace plumb
