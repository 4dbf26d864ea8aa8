#include "modules/ground/cues/road_point_vote.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "modules/ground/cues/chord.hpp"
#include "tests/ground/road_scene.hpp"

namespace plumb {
namespace {

constexpr double kVoMetres = 1.3;

struct Seen {
  PointsMeasurement points;
  double true_ln_height;
  test::TruePlane truth;
};

Seen see(const test::VoScript& script, double expected_ratio) {
  test::Drive drive;
  const std::vector<Se3> poses = drive.poses(8);
  VoOutput vo;
  test::script_vo(poses, 7, script, &vo);
  const test::TruePlane truth = test::plane_in(poses[7]);
  const double height = truth.height_m / script.metres_per_vo;
  VoteRequest request;
  request.normal_cam = truth.normal_cam;
  request.height = expected_ratio * height;
  request.min_ray_slope = 0.028;
  request.road = {3.3, 12.0, 1.1, 0.0};
  RoadPointVote cue;
  return {cue.measure(vo, request), std::log(height), truth};
}

TEST(RoadPointVote, FindsTheHeightOfRoadPoints) {
  const Seen seen = see({.metres_per_vo = kVoMetres}, 1.0);
  ASSERT_TRUE(seen.points.ok);
  EXPECT_NEAR(seen.points.ln_height, seen.true_ln_height, 0.01);
  // The centre lies on the plane at that height.
  EXPECT_NEAR(std::log(seen.truth.normal_cam.dot(seen.points.centre)), seen.points.ln_height, 0.01);
}

TEST(RoadPointVote, FindsItWithoutKnowingTheHeight) {
  const Seen seen = see({.metres_per_vo = kVoMetres}, 0.0);
  ASSERT_TRUE(seen.points.ok);
  EXPECT_NEAR(seen.points.ln_height, seen.true_ln_height, 0.01);
}

TEST(RoadPointVote, OutvotesPointsThatStandAboveTheRoad) {
  const Seen seen = see({.metres_per_vo = kVoMetres, .num_points = 60, .num_outliers = 90}, 1.1);
  ASSERT_TRUE(seen.points.ok);
  EXPECT_NEAR(seen.points.ln_height, seen.true_ln_height, 0.02);
}

TEST(RoadPointVote, IsSilentWithoutPoints) {
  const Seen seen = see({.num_points = 0, .num_outliers = 0}, 1.0);
  EXPECT_FALSE(seen.points.ok);
  EXPECT_EQ(seen.points.num_candidates, 0);
}

TEST(RoadPointVote, RefusesNaNPoints) {
  VoOutput vo;
  RoadPoint bad;
  bad.p_cam.setConstant(std::nanf(""));
  bad.rel_std = std::nanf("");
  for (int i = 0; i < 20; ++i) (void)vo.road_points.push_back(bad);
  RoadPointVote cue;
  VoteRequest request;
  request.height = 1.0;
  request.road = {3.3, 12.0, 1.1, 0.0};
  EXPECT_FALSE(cue.measure(vo, request).ok);
  EXPECT_EQ(cue.rough_height(vo, Eigen::Vector3d::UnitY()), 0.0);
}

TEST(Chord, NormalIsPerpendicularToTheChord) {
  test::Drive drive;
  drive.mount_pitch_rad = 0.03;
  const std::vector<Se3> poses = drive.poses(8);
  VoOutput vo;
  test::script_vo(poses, 7, {}, &vo);
  const Chord chord = measure_chord(vo);
  ASSERT_TRUE(chord.valid);
  EXPECT_EQ(chord.num_frames, 5);
  const Eigen::Vector3d truth = test::plane_in(poses[7]).normal_cam;
  const Eigen::Vector3d normal = normal_across(chord.direction, truth.x());
  EXPECT_GT(normal.dot(truth), 1.0 - 1e-6);
}

TEST(Chord, RightTurnsHavePositiveCurvature) {
  test::Drive drive;
  drive.turn_left_rad = -0.02;
  VoOutput vo;
  test::script_vo(drive.poses(8), 7, {.metres_per_vo = 1.0}, &vo);
  EXPECT_NEAR(measure_chord(vo).curvature, 0.02 / drive.step_m, 2e-3);
}

TEST(Chord, ACarThatReversesMovesAlongTheSameLine) {
  test::Drive drive;
  drive.mount_pitch_rad = 0.03;
  drive.turn_left_rad = -0.02;
  std::vector<Se3> poses = drive.poses(16);
  VoOutput ahead, back;
  test::script_vo(poses, 10, {.metres_per_vo = 1.0}, &ahead);
  std::reverse(poses.begin(), poses.end());
  test::script_vo(poses, 10, {.metres_per_vo = 1.0}, &back);
  const Chord chord = measure_chord(back);
  ASSERT_TRUE(chord.valid);
  EXPECT_GT(chord.direction.dot(measure_chord(ahead).direction), 0.99);
  EXPECT_NEAR(chord.curvature, measure_chord(ahead).curvature, 2e-3);
}

}  // namespace
}  // namespace plumb
