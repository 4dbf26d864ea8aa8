#include "modules/ground_paper/plane_kalman.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "modules/ground_paper/paper_model.hpp"
#include "tests/ground/road_scene.hpp"

namespace plumb {
namespace {

TEST(CueFusion, WeighsByInformationAndLeavesOutWhatACueDoesNotSee) {
  CueFusion fused;
  fused.add(kH, 1.6, 0.01);
  fused.add(kH, 1.9, 0.03);
  fused.add(kN3, 0.02, 1e-4);
  EXPECT_FALSE(fused.observes(kN1));
  EXPECT_NEAR(fused.value(kH), (3.0 * 1.6 + 1.9) / 4.0, 1e-12);
  EXPECT_NEAR(fused.var(kH), 0.0075, 1e-12);
  EXPECT_DOUBLE_EQ(fused.value(kN3), 0.02);
  EXPECT_DOUBLE_EQ(fused.var(kN3), 1e-4);
}

// Equation (5) followed by (3)-(4) is the least-squares estimate of all cues and the prior
// together.
TEST(PlaneKalman, EqualsTheBatchSolutionOfAllCues) {
  PlaneKalman filter({0.001, 0.01});
  filter.start({0.0, 1.0, 0.0}, 1.65, 4e-4, 0.04);
  const double cues[][2] = {{1.55, 0.02}, {1.72, 0.005}, {1.60, 0.01}};
  CueFusion fused;
  double information = 1.0 / 0.04;
  double weighted = 1.65 / 0.04;
  for (const auto& cue : cues) {
    fused.add(kH, cue[0], cue[1]);
    information += 1.0 / cue[1];
    weighted += cue[0] / cue[1];
  }
  fused.add(kN3, 0.01, 1e-4);
  filter.observe(fused);
  EXPECT_NEAR(filter.height(), weighted / information, 1e-12);
  EXPECT_NEAR(filter.cov()(3, 3), 1.0 / information, 1e-12);
  EXPECT_NEAR(filter.normal().z(), 0.01 / 1e-4 / (1.0 / 4e-4 + 1.0 / 1e-4), 1e-12);
  EXPECT_NEAR(filter.normal().norm(), 1.0, 1e-12);
}

// The paper mixes the signs of its equations. This test has a plane that stays in the world while
// the camera drives, pitches and turns over it.
TEST(PlaneKalman, PredictsTheRoadThatARenderedCarDrivesOn) {
  test::Drive drive;
  drive.pitch_amplitude_rad = 0.02;
  drive.turn_left_rad = 0.03;
  const std::vector<Se3> poses = drive.poses(30);
  PlaneKalman filter({1e-4, 1e-4});
  const test::TruePlane first = test::plane_in(poses[0]);
  filter.start(first.normal_cam, first.height_m, 1e-4, 1e-4);
  for (std::size_t k = 1; k < poses.size(); ++k) {
    filter.predict(poses[k - 1].inverse() * poses[k]);
    const test::TruePlane truth = test::plane_in(poses[k]);
    EXPECT_LT((filter.normal() - truth.normal_cam).norm(), 1e-9);
    EXPECT_NEAR(filter.height(), truth.height_m, 1e-9);
  }
}

TEST(PlaneKalman, CarriesATiltIntoTheHeightThatFollowsFromIt) {
  // After 1 m towards a road that rises by 0.02, the camera is 2 cm nearer to it.
  PlaneKalman filter({0.0, 0.0});
  filter.start(Eigen::Vector3d(0.0, std::sqrt(1.0 - 4e-4), 0.02), 1.65, 1e-4, 0.0);
  filter.predict({Eigen::Matrix3d::Identity(), {0.0, 0.0, 1.0}});
  EXPECT_NEAR(filter.height(), 1.63, 1e-12);
  EXPECT_NEAR(filter.cov()(3, 3), 1e-4, 1e-12);
  EXPECT_NEAR(filter.cov()(2, 3), -1e-4, 1e-12);
}

TEST(PlaneKalman, KeepsRelativeDeviationsInAnotherUnit) {
  PlaneKalman filter({0.001, 0.01});
  filter.start({0.0, 1.0, 0.0}, 1.8, 1e-4, 0.0324);
  filter.divide_unit(1.2);
  EXPECT_DOUBLE_EQ(filter.height(), 1.5);
  EXPECT_NEAR(filter.cov()(3, 3) / (1.5 * 1.5), 0.0324 / (1.8 * 1.8), 1e-12);
}

TEST(LinearVariance, StaysInItsRangeAndDistrustsWhatHasNoConfidence) {
  const LinearVariance line{0.01, 0.1, 0.005, 0.05, 0.02};
  EXPECT_DOUBLE_EQ(line.of(0.1), 0.02);
  EXPECT_DOUBLE_EQ(line.of(-1.0), 0.005);
  EXPECT_DOUBLE_EQ(line.of(9.0), 0.05);
  EXPECT_DOUBLE_EQ(line.of(std::numeric_limits<double>::infinity()), 0.05);
  EXPECT_DOUBLE_EQ(line.of(std::numeric_limits<double>::quiet_NaN()), 0.05);
}

TEST(LinearVariance, OfTheBuiltInModelGrowsWithDoubt) {
  const PaperModel model = built_in_paper_model();
  for (const LinearVariance* line : {&model.dense_n1, &model.dense_n3, &model.dense_h}) {
    EXPECT_GT(line->slope, 0.0);
  }
  EXPECT_LT(model.points_h.slope, 0.0);
  for (const LinearVariance* line :
       {&model.dense_n1, &model.dense_n3, &model.dense_h, &model.points_h}) {
    EXPECT_GT(line->least, 0.0);
    EXPECT_LT(line->least, line->most);
    EXPECT_GT(line->mean, line->least);
    EXPECT_LT(line->mean, line->most);
  }
}

}  // namespace
}  // namespace plumb
