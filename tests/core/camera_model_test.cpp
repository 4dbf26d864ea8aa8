#include "core/camera_model.hpp"

#include <gtest/gtest.h>

#include "core/principal_point.hpp"

namespace plumb {
namespace {

CameraModel kitti_like(double k1) {
  return {.width_px = 1242,
          .height_px = 375,
          .fx_px = 721.5,
          .fy_px = 718.9,
          .cx_px = 609.6,
          .cy_px = 172.9,
          .residual_k1 = k1};
}

TEST(CameraModel, PointRightAndBelowProjectsRightAndDown) {
  const Eigen::Vector2d px = kitti_like(0.0).project({1.0, 1.65, 10.0});
  EXPECT_NEAR(px.x(), 609.6 + 72.15, 1e-9);
  EXPECT_NEAR(px.y(), 172.9 + 0.165 * 718.9, 1e-9);
}

TEST(CameraModel, PositiveRadialTermMovesPointsOutwards) {
  const Eigen::Vector3d corner(-8.0, 2.0, 10.0);
  const Eigen::Vector2d plain = kitti_like(0.0).project(corner);
  const Eigen::Vector2d bent = kitti_like(0.008).project(corner);
  EXPECT_LT(bent.x(), plain.x());
  EXPECT_GT(bent.y(), plain.y());
}

TEST(CameraModel, SecondRadialTermGrowsWithTheFourthPower) {
  CameraModel camera = kitti_like(0.0);
  camera.residual_k2 = 0.01;
  const auto shift = [&camera](double x) {
    return (camera.from_normalized({x, 0.0}).x() - camera.cx_px) / camera.fx_px / x - 1.0;
  };
  EXPECT_NEAR(shift(0.4), 0.01 * 0.4 * 0.4 * 0.4 * 0.4, 1e-12);
  EXPECT_NEAR(shift(0.8) / shift(0.4), 16.0, 1e-9);
}

TEST(CameraModel, DistortionJacobianIsTheSlopeOfTheProjection) {
  CameraModel camera = kitti_like(0.0256);
  camera.residual_k2 = -0.0076;
  const Eigen::Vector2d xy(-0.6, 0.2);
  const Eigen::Matrix2d J = camera.distortion_jacobian(xy);
  const double step = 1e-6;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d d = step * Eigen::Vector2d::Unit(i);
    const Eigen::Vector2d slope =
        (camera.from_normalized(xy + d) - camera.from_normalized(xy - d)) / (2.0 * step);
    EXPECT_NEAR(slope.x(), camera.fx_px * J(0, i), 1e-5);
    EXPECT_NEAR(slope.y(), camera.fy_px * J(1, i), 1e-5);
  }
}

TEST(CameraModel, UnprojectInvertsProjectOverTheWholeImage) {
  for (const double k1 : {-0.05, 0.0, 0.008, 0.0256, 0.05}) {
    CameraModel camera = kitti_like(k1);
    camera.residual_k2 = -0.3 * k1;
    for (double u = 0.0; u < camera.width_px; u += 41.0) {
      for (double v = 0.0; v < camera.height_px; v += 34.0) {
        const Eigen::Vector3d ray = camera.unproject({u, v});
        EXPECT_EQ(ray.z(), 1.0);
        EXPECT_LT((camera.project(7.0 * ray) - Eigen::Vector2d(u, v)).norm(), 1e-5)
            << "k1 " << k1 << " at " << u << ", " << v;
      }
    }
  }
}

TEST(PrincipalPoint, BelongsWithinATenthOfTheMiddle) {
  CameraModel camera;
  camera.width_px = 1001;
  camera.height_px = 401;
  for (const double off : {-0.099, 0.0, 0.099}) {
    camera.cx_px = 500.0 + off * 1001.0;
    camera.cy_px = 200.0 - off * 401.0;
    EXPECT_TRUE(is_principal_point_central(camera)) << off;
  }
  camera.cx_px = 500.0 + 0.101 * 1001.0;
  EXPECT_FALSE(is_principal_point_central(camera));
  camera.cx_px = 500.0;
  camera.cy_px = 200.0 - 0.101 * 401.0;
  EXPECT_FALSE(is_principal_point_central(camera));
}

}  // namespace
}  // namespace plumb
