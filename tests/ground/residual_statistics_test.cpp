/// Tests the residuals between the cues and the fused plane, over the distance travelled and
/// through frames without a cue.
#include "modules/ground/covariance/residual_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "modules/ground/types/plane_state.hpp"

namespace plumb {
namespace {

const Eigen::Vector3d kState(0.01, 0.02, 0.1);

/// A frame of half a camera height in which the dense cue is tilted by (n1, n3) from kState and the
/// path follows the fused plane.
struct FrameApart {
  FrameApart(double n1, double n3) {
    const Eigen::Vector3d state = kState + Eigen::Vector3d(n1, n3, 0.0);
    dense.q = normal_of_state(state) * std::exp(-state(2));
    const Eigen::Vector3d normal = normal_of_state(kState);
    direction = (Eigen::Vector3d::UnitZ() - normal.z() * normal).normalized();
  }
  [[nodiscard]] ResidualFrame frame() const {
    return {context, direction, used ? &dense : nullptr};
  }
  CueContext context{0.01, 0.5};
  DenseMeasurement dense;
  Eigen::Vector3d direction;
  bool used = true;
};

TEST(ResidualStatistics, AreSquaresOfTheTiltBetweenCueAndPlane) {
  ResidualStatistics residuals;
  residuals.add(FrameApart(0.002, -0.005).frame(), kState);
  EXPECT_NEAR(residuals.context().dense_n1_square, 4e-6, 1e-12);
  EXPECT_NEAR(residuals.context().dense_n3_square, 25e-6, 1e-12);
  EXPECT_NEAR(residuals.context().chord_square, 0.0, 1e-15);
  EXPECT_EQ(residuals.context().cue.turn_ratio, 0.01);
  EXPECT_EQ(residuals.context().cue.step_ratio, 0.5);
}

TEST(ResidualStatistics, SeeATranslationThatLeavesThePlane) {
  FrameApart apart(0.0, 0.0);
  apart.direction = (apart.direction + 0.01 * normal_of_state(kState)).normalized();
  ResidualStatistics residuals;
  residuals.add(apart.frame(), kState);
  EXPECT_NEAR(std::sqrt(residuals.context().chord_square), 0.01, 1e-5);
}

TEST(ResidualStatistics, FadeOverDistanceNotOverFrames) {
  const auto after = [](double step_ratio, int num_frames) {
    ResidualStatistics residuals;
    residuals.add(FrameApart(0.004, 0.0).frame(), kState);
    for (int i = 0; i < num_frames; ++i) {
      FrameApart together(0.0, 0.0);
      together.context.step_ratio = step_ratio;
      residuals.add(together.frame(), kState);
    }
    return residuals.context().dense_n1_square;
  };
  EXPECT_NEAR(after(0.5, 6), after(0.1, 30), 1e-12);
  EXPECT_NEAR(after(0.5, 10) / 16e-6, std::exp(-1.0), 1e-9);
  EXPECT_NEAR(after(0.0, 50), 16e-6, 1e-12);  // nothing fades while the car stands
}

TEST(ResidualStatistics, KeepTheMeanWhereTheCueWasNotUsed) {
  ResidualStatistics residuals;
  residuals.add(FrameApart(0.0, 0.006).frame(), kState);
  FrameApart unused(0.0, 0.5);
  unused.used = false;
  residuals.add(unused.frame(), kState);
  EXPECT_NEAR(residuals.context().dense_n3_square, 36e-6, 1e-12);
  residuals.reset();
  EXPECT_EQ(residuals.context().dense_n3_square, 0.0);
  residuals.add(FrameApart(0.0, 0.001).frame(), kState);
  EXPECT_NEAR(residuals.context().dense_n3_square, 1e-6, 1e-12);
}

}  // namespace
}  // namespace plumb
