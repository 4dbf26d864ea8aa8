#include "modules/ground/filter/plane_angles.hpp"

#include <gtest/gtest.h>

#include "tests/support/central_difference.hpp"

namespace plumb {
namespace {

Eigen::Vector3d normal_of(double pitch_rad, double roll_rad) {
  return {std::cos(pitch_rad) * std::sin(roll_rad), std::cos(pitch_rad) * std::cos(roll_rad),
          std::sin(pitch_rad)};
}

TEST(PlaneAngles, NoseDownIsPositivePitch) {
  // A camera that looks down onto the road has part of "down" ahead of it.
  EXPECT_NEAR(pitch_of(Eigen::Vector3d(0.0, std::cos(0.1), std::sin(0.1))), 0.1, 1e-15);
  // Road points ahead then rise in the image, and the ray to the horizon lies above the axis.
  const Eigen::Vector3d n = normal_of(0.1, 0.0);
  const Eigen::Vector3d horizon(0.0, -n.z(), n.y());
  EXPECT_NEAR(n.dot(horizon), 0.0, 1e-15);
  EXPECT_LT(horizon.y(), 0.0);
}

TEST(PlaneAngles, RightSideDownIsPositiveRoll) {
  // Right side down: the x axis of the camera dips towards the road.
  EXPECT_NEAR(roll_of(Eigen::Vector3d(std::sin(0.1), std::cos(0.1), 0.0)), 0.1, 1e-15);
}

TEST(PlaneAngles, AreTheIso8855SequenceOfTheCameraInGroundAxes) {
  for (const double pitch : {-0.2, 0.03, 0.15}) {
    for (const double roll : {-0.1, 0.0, 0.2}) {
      // R_ground_veh = Ry(pitch) Rx(roll); veh axes x = cam z, y = -cam x, z = -cam y.
      const Eigen::Matrix3d R_ground_veh =
          exp_so3(pitch * Eigen::Vector3d::UnitY()) * exp_so3(roll * Eigen::Vector3d::UnitX());
      Eigen::Matrix3d R_veh_cam;
      R_veh_cam << 0, 0, 1, -1, 0, 0, 0, -1, 0;
      const Eigen::Matrix3d R_ground_cam = R_ground_veh * R_veh_cam;
      const Eigen::Vector3d n = R_ground_cam.transpose() * -Eigen::Vector3d::UnitZ();
      EXPECT_NEAR(pitch_of(n), pitch, 1e-12);
      EXPECT_NEAR(roll_of(n), roll, 1e-12);
      EXPECT_TRUE(rotation_ground_cam(n).isApprox(R_ground_cam, 1e-12));
    }
  }
}

TEST(PlaneAngles, JacobianMatchesCentralDifferences) {
  const Eigen::Vector3d n = normal_of(0.12, -0.08);
  const auto angles = [](const Eigen::Vector2d& n13) {
    const Eigen::Vector3d m(n13(0), std::sqrt(1.0 - n13.squaredNorm()), n13(1));
    return Eigen::Vector2d(pitch_of(m), roll_of(m));
  };
  const Eigen::Matrix2d expected =
      test::central_difference<2, 2>(angles, Eigen::Matrix<double, 2, 1>(n.x(), n.z()), 1e-6);
  EXPECT_TRUE(angles_jacobian(n).isApprox(expected, 1e-7));
}

}  // namespace
}  // namespace plumb
