#include "modules/detections/foot_point.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/numbers.hpp"
#include "tests/support/central_difference.hpp"

namespace plumb {
namespace {

using Vector1d = Eigen::Matrix<double, 1, 1>;

CameraModel camera(double k1) { return {1242, 375, 721.5, 719.0, 609.6, 172.9, k1, 0.0, 1.65}; }

RoadPlane plane(double pitch_rad, double roll_rad, double height_m) {
  RoadPlane result;
  result.pitch_rad = pitch_rad;
  result.roll_rad = roll_rad;
  result.height_m = height_m;
  return result;
}

/// Planes of a level, nose-down, nose-up and rolled camera at different heights.
const std::array<RoadPlane, 4> kPlanes{plane(0.0, 0.0, 1.65), plane(0.02, 0.0, 1.3),
                                       plane(-0.015, 0.01, 1.9), plane(0.01, -0.03, 1.65)};

/// Boxes (u, v_foot, v_head) whose foot is below the horizon of every plane.
const std::array<Eigen::Vector3d, 4> kBoxes{
    Eigen::Vector3d(609.6, 200.0, 170.0), Eigen::Vector3d(200.0, 300.0, 150.0),
    Eigen::Vector3d(1000.0, 230.0, 190.0), Eigen::Vector3d(700.0, 350.0, 180.0)};

TEST(RoadPlane, AxesAreForwardLeftUpAndTheCameraStandsOverTheOrigin) {
  for (const RoadPlane& road : kPlanes) {
    const Eigen::Matrix3d R = road.R_ground_cam();
    EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_LT((R.row(2).transpose() + road.normal_cam()).norm(), 1e-14);
    EXPECT_NEAR((R * Eigen::Vector3d::UnitZ()).y(), 0.0, 1e-14);
    EXPECT_GT((R * Eigen::Vector3d::UnitZ()).x(), 0.99);
    EXPECT_LT((R * Eigen::Vector3d::UnitX()).y(), -0.99);
    const Eigen::Vector3d below = road.height_m * road.normal_cam();
    EXPECT_LT(road.ground_from_cam(below).norm(), 1e-14);
  }
}

TEST(RoadPlane, GroundAndCameraCoordinatesAreInverses) {
  const Eigen::Vector3d p_cam(-3.0, 1.2, 17.0);
  for (const RoadPlane& road : kPlanes) {
    EXPECT_LT((road.cam_from_ground(road.ground_from_cam(p_cam)) - p_cam).norm(), 1e-13);
  }
}

TEST(RoadPlane, NoseDownRaisesTheHorizonInTheImage) {
  // When the camera looks down, a far point on the road appears above the principal point.
  const RoadPlane road = plane(0.02, 0.0, 1.65);
  const Eigen::Vector3d far_cam = road.cam_from_ground({1e6, 0.0, 0.0});
  EXPECT_LT(camera(0.0).project(far_cam).y(), camera(0.0).cy_px);
}

TEST(FootPoint, FindsThePointThatWasProjected) {
  for (const double k1 : {0.0, 0.01}) {
    for (const RoadPlane& road : kPlanes) {
      const Eigen::Vector3d p_cam = road.cam_from_ground({24.0, -3.5, 0.0});
      const auto foot = back_project_foot(camera(k1), road, camera(k1).project(p_cam));
      ASSERT_TRUE(foot.has_value());
      EXPECT_LT((*foot - p_cam).norm(), 1e-7);
      EXPECT_NEAR(road.ground_from_cam(*foot).z(), 0.0, 1e-9);
    }
  }
}

TEST(FootPoint, IsTheWorkedExampleOfALevelCamera) {
  // A foot 72.15 px below the horizon at f = 721.5 stands ten camera heights ahead.
  const CameraModel simple{1242, 375, 721.5, 721.5, 600.0, 170.0, 0.0, 0.0, 1.5};
  const auto foot = back_project_foot(simple, plane(0.0, 0.0, 1.5), {624.05, 242.15});
  ASSERT_TRUE(foot.has_value());
  EXPECT_LT((*foot - Eigen::Vector3d(0.5, 1.5, 15.0)).norm(), 1e-12);
}

TEST(FootPoint, RefusesRaysThatMissTheRoad) {
  const RoadPlane road = plane(0.0, 0.0, 1.65);
  EXPECT_FALSE(back_project_foot(camera(0.0), road, {600.0, 172.9}).has_value());
  EXPECT_FALSE(back_project_foot(camera(0.0), road, {600.0, 100.0}).has_value());
  EXPECT_TRUE(back_project_foot(camera(0.0), road, {600.0, 174.0}).has_value());
}

TEST(PitchFromBox, RecoversThePitchExactlyWithoutRoll) {
  for (const double pitch_deg : {-3.0, -0.5, 0.0, 0.3, 2.0}) {
    const RoadPlane road = plane(pitch_deg * kDegree, 0.0, 1.65);
    for (const double height_m : {0.8, 1.52, 3.5}) {
      const Eigen::Vector2d foot_px = camera(0.0).project(road.cam_from_ground({18.0, 2.0, 0.0}));
      const double head_v_px = camera(0.0).project(road.cam_from_ground({18.0, 2.0, height_m})).y();
      const auto pitch = pitch_from_box(camera(0.0), 0.0, foot_px, head_v_px, height_m / 1.65);
      ASSERT_TRUE(pitch.has_value());
      EXPECT_NEAR(pitch->pitch_rad, road.pitch_rad, 1e-12);
    }
  }
}

TEST(PitchFromBox, FollowsTheRoll) {
  for (const double roll_deg : {-2.0, 2.0}) {
    const RoadPlane road = plane(0.3 * kDegree, roll_deg * kDegree, 1.65);
    const Eigen::Vector2d foot_px = camera(0.0).project(road.cam_from_ground({20.0, 4.0, 0.0}));
    const double head_v_px = camera(0.0).project(road.cam_from_ground({20.0, 4.0, 1.5})).y();
    const auto pitch = pitch_from_box(camera(0.0), road.roll_rad, foot_px, head_v_px, 1.5 / 1.65);
    ASSERT_TRUE(pitch.has_value());
    EXPECT_NEAR(pitch->pitch_rad, road.pitch_rad, 0.01 * kDegree);
  }
}

TEST(PitchFromBox, IsTheLinearFormOfTheHorizonRowToAThousandth) {
  // The linear form is v_h = v_foot - (v_foot - v_head) h / H.
  const auto pitch = pitch_from_box(camera(0.0), 0.0, {600.0, 220.0}, 180.0, 0.9);
  ASSERT_TRUE(pitch.has_value());
  const double v_h = 220.0 - 40.0 / 0.9;
  EXPECT_NEAR(pitch->pitch_rad, -std::atan((v_h - 172.9) / 719.0), 1e-4);
}

TEST(PitchFromBox, DerivativesAgreeWithDifferences) {
  for (const double k1 : {0.0, 0.01}) {
    for (const double roll : {0.0, 0.02}) {
      for (const Eigen::Vector3d& box : kBoxes) {
        const auto pitch = pitch_from_box(camera(k1), roll, box.head<2>(), box.z(), 0.92);
        ASSERT_TRUE(pitch.has_value());
        const auto by_pixel = [&](const Eigen::Vector3d& x) {
          return Vector1d(pitch_from_box(camera(k1), roll, x.head<2>(), x.z(), 0.92)->pitch_rad);
        };
        const auto by_roll_and_ratio = [&](const Eigen::Vector2d& x) {
          return Vector1d(pitch_from_box(camera(k1), x.x(), box.head<2>(), box.z(), std::exp(x.y()))
                              ->pitch_rad);
        };
        const auto J_px = test::central_difference<1, 3>(by_pixel, box, 1e-4);
        const auto J = test::central_difference<1, 2>(by_roll_and_ratio,
                                                      Eigen::Vector2d(roll, std::log(0.92)), 1e-6);
        EXPECT_LT((J_px.transpose() - pitch->J_px).norm(), 1e-6 * pitch->J_px.norm());
        EXPECT_NEAR(J(0), pitch->J_roll, 1e-7);
        EXPECT_NEAR(J(1), pitch->J_log_ratio, 1e-7);
      }
    }
  }
}

TEST(PitchFromBox, RefusesABoxUpsideDown) {
  EXPECT_FALSE(pitch_from_box(camera(0.0), 0.0, {600.0, 180.0}, 220.0, 0.9).has_value());
  EXPECT_FALSE(pitch_from_box(camera(0.0), 0.0, {600.0, 180.0}, 180.0, 0.9).has_value());
}

}  // namespace
}  // namespace plumb
