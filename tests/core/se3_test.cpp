#include "core/se3.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace plumb {
namespace {

const std::array<Eigen::Vector3d, 6> kRotations{
    Eigen::Vector3d(0, 0, 0),          Eigen::Vector3d(1e-9, -2e-9, 3e-9),
    Eigen::Vector3d(0.01, 0.2, -0.03), Eigen::Vector3d(-1.2, 0.4, 2.0),
    Eigen::Vector3d(0, 3.1, 0),        Eigen::Vector3d(3.0, 0.5, -0.5)};

TEST(Se3, ExponentialAgreesWithAngleAxis) {
  for (const Eigen::Vector3d& w : kRotations) {
    const double angle = w.norm();
    const Eigen::Matrix3d expected = angle < 1e-12
                                         ? Eigen::Matrix3d::Identity()
                                         : Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
    EXPECT_LT((exp_so3(w) - expected).norm(), 1e-12) << w.transpose();
  }
}

TEST(Se3, LogarithmInvertsExponential) {
  for (const Eigen::Vector3d& w : kRotations) {
    EXPECT_LT((log_so3(exp_so3(w)) - w).norm(), 1e-9) << w.transpose();
  }
}

TEST(Se3, LogarithmOfHalfTurnHasLengthPi) {
  const Eigen::Matrix3d half_turn = Eigen::Vector3d(-1, 1, -1).asDiagonal();
  EXPECT_NEAR(log_so3(half_turn).norm(), std::numbers::pi, 1e-12);
}

TEST(Se3, HatIsTheCrossProduct) {
  const Eigen::Vector3d a(1, -2, 3);
  const Eigen::Vector3d b(0.5, 4, -1);
  EXPECT_LT((hat(a) * b - a.cross(b)).norm(), 1e-15);
}

TEST(Se3, InnerFramesCancel) {
  const Se3 T_a_b{exp_so3({0.1, -0.2, 0.3}), {1, 2, 3}};
  const Se3 T_b_c{exp_so3({-0.4, 0.1, 0.2}), {-1, 0.5, 2}};
  const Eigen::Vector3d p_c(0.3, -0.7, 5.0);
  EXPECT_LT(((T_a_b * T_b_c) * p_c - T_a_b * (T_b_c * p_c)).norm(), 1e-12);
  const Se3 identity = T_a_b * T_a_b.inverse();
  EXPECT_LT((identity.R - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_LT(identity.t.norm(), 1e-12);
}

TEST(Se3, NormalizeRestoresOrthogonality) {
  Se3 T{exp_so3({0.1, 0.2, 0.3}) * 1.001, Eigen::Vector3d::Zero()};
  T.normalize();
  EXPECT_LT((T.R * T.R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

}  // namespace
}  // namespace plumb
