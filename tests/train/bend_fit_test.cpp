/// Tests whether the fit finds the bends of roads and the accuracy of the direction of translation
/// with which drives were drawn.
#include "tools/learn/train/bend_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/train/drawn.hpp"
#include "tools/learn/train/fit.hpp"

namespace plumb {
namespace {

struct Drawn {
  RoadBend bend;
  double chord_std = 0.0;
};

/// Draws three drives of `num` frames, of half a camera height each. The bends of their roads
/// follow a first-order process.
std::vector<DriveSamples> drives_over(const Drawn& drawn, int num) {
  std::vector<DriveSamples> drives;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const char* name : {"a", "b", "c"}) {
    drives.push_back(test::draw_drive(name, num, drives.size(), 0.01));
    double bend = drawn.bend.start_std * normal(random);
    for (Sample& s : drives.back().frames) {
      const double keep = std::exp(-s.step_ratio / drawn.bend.correlation_length_ratio);
      bend = keep * bend + std::sqrt(1.0 - keep * keep) * drawn.bend.start_std * normal(random);
      s.chord_err = s.chord_ref = bend + drawn.chord_std * normal(random);
      s.true_height_m =
          s.nominal_height_m * std::exp(drawn.bend.height_slope * bend + 0.004 * normal(random));
    }
  }
  return drives;
}

TEST(BendFit, FindsTheRoadsThatDrivesWereDrawnOver) {
  const RoadBend drawn{0.008, 2.5, 2.2};
  const auto bend = fit_bend(drives_over({drawn, 0.001}, 3000));
  ASSERT_TRUE(bend.has_value());
  EXPECT_NEAR(bend->start_std, drawn.start_std, 0.0008);
  EXPECT_NEAR(bend->correlation_length_ratio, drawn.correlation_length_ratio, 0.5);
  EXPECT_NEAR(bend->height_slope, drawn.height_slope, 0.15);
}

TEST(BendFit, NeedsTruePlanes) {
  auto drives = drives_over({{0.008, 2.5, 2.2}, 0.001}, 100);
  for (DriveSamples& drive : drives)
    for (Sample& s : drive.frames) s.has_plane = 0.0;
  EXPECT_FALSE(fit_bend(drives).has_value());
}

TEST(BendFit, KeepsACorrelationLengthThatAModelMayHaveWhereBendsAreNoise) {
  const auto bend = fit_bend(drives_over({{0.008, 1e-3, 2.2}, 0.001}, 300));
  ASSERT_TRUE(bend.has_value());
  EXPECT_GE(bend->correlation_length_ratio, 0.1);
  EXPECT_LT(bend->correlation_length_ratio, 0.5);
}

TEST(BendFit, DoesNotTakeBendsForNoiseOfTheDirectionOfTravel) {
  const auto chord_std = [](const Drawn& drawn) {
    const GroundModel model = fit_targets(drives_over(drawn, 600), built_in_ground_model());
    return std::sqrt(model.chord.of({}));
  };
  EXPECT_NEAR(chord_std({{0.012, 200.0, 2.2}, 0.003}), 0.003, 0.0007);
  EXPECT_NEAR(chord_std({{0.012, 200.0, 2.2}, 0.006}), 0.006, 0.0012);
}

}  // namespace
}  // namespace plumb
