#include "modules/ground/cues/objects_pitch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/detections/road_scene.hpp"

namespace plumb {
namespace {

using test::kSceneCamera;
using test::six_cars;

ObjectsPitchInput input_of(const DetectionFrame& frame) {
  ObjectsPitchInput input;
  input.frame = &frame;
  input.height_m = 1.65;
  return input;
}

TEST(ObjectsPitch, FindsThePitchOfARoadWithCarsOfKnownHeight) {
  for (const double pitch_deg : {-1.5, 0.0, 0.7}) {
    ObjectsPitch cue(DetectionsConfig{}, kSceneCamera);
    const DetectionFrame frame = test::seen(six_cars(), test::road(pitch_deg * kDegree));
    const ObjectsPitchOutput& output = cue.update(input_of(frame));
    ASSERT_EQ(output.status, ObjectsPitchStatus::kValid);
    EXPECT_EQ(output.num_used, 6);
    EXPECT_NEAR(output.n3, std::sin(pitch_deg * kDegree), 0.02 * kDegree);
    EXPECT_GT(output.quality, 0.9);
  }
}

TEST(ObjectsPitch, NoseDownIsPositive) {
  // Looking down lifts every box in the image.
  ObjectsPitch cue(DetectionsConfig{}, kSceneCamera);
  DetectionFrame frame = test::seen(six_cars(), test::road(0.0));
  for (Detection& d : frame.detections) {
    d.box.top_px -= 10.0;
    d.box.bottom_px -= 10.0;
  }
  EXPECT_NEAR(cue.update(input_of(frame)).n3, 10.0 / 721.5, 0.001);
}

TEST(ObjectsPitch, FollowsAKnownRoll) {
  ObjectsPitch cue(DetectionsConfig{}, kSceneCamera);
  const DetectionFrame frame = test::seen(six_cars(), test::road(0.5 * kDegree, 1.5 * kDegree));
  ObjectsPitchInput input = input_of(frame);
  input.roll_rad = 1.5 * kDegree;
  EXPECT_NEAR(cue.update(input).n3, std::sin(0.5 * kDegree), 0.05 * kDegree);
}

TEST(ObjectsPitch, VarianceOfASingleBoxIsTheClosedForms) {
  DetectionsConfig config;
  config.height_bias_std_ratio = 0.0;
  config.road_bend_std_rad_m = 0.0;
  config.edge_std_px = 0.05;
  config.edge_std_ratio = 0.0;
  ObjectsPitch cue(config, kSceneCamera);
  const DetectionFrame frame = test::seen({{1, 36.0, 0.0}}, test::road(0.0));
  ObjectsPitchInput input = input_of(frame);
  input.height_std_ratio = 0.0;
  const ObjectsPitchOutput& output = cue.update(input);
  // var(v_h) = (dv h / H^2)^2 var(H) + pixel: dv = 30.7 px, H = 1.53 m, sd 0.12 m.
  const double dv_px = 721.5 * 1.53 / 36.0;
  const double expected = dv_px * 1.65 / (1.53 * 1.53) * 0.12 / 721.5;
  EXPECT_NEAR(std::sqrt(output.n3_var), expected, 0.02 * expected);
}

TEST(ObjectsPitch, TwoBadBoxesOfSixDoNotDragThePlane) {
  for (const double shift_px : {-60.0, -25.0, 25.0, 60.0}) {
    ObjectsPitch cue(DetectionsConfig{}, kSceneCamera);
    DetectionFrame frame = test::seen(six_cars(), test::road(0.3 * kDegree));
    for (const std::size_t bad : {2u, 4u}) {
      frame.detections[bad].box.top_px += shift_px < 0 ? shift_px : 0.4 * shift_px;
      frame.detections[bad].box.bottom_px += shift_px;
    }
    const ObjectsPitchOutput& output = cue.update(input_of(frame));
    ASSERT_EQ(output.status, ObjectsPitchStatus::kValid) << shift_px;
    EXPECT_NEAR(output.n3, std::sin(0.3 * kDegree), 0.3 * kDegree) << shift_px;
  }
}

TEST(ObjectsPitch, NamesABoxThatContradictsTheOthers) {
  ObjectsPitch cue(DetectionsConfig{}, kSceneCamera);
  DetectionFrame frame = test::seen(six_cars(), test::road(0.0));
  frame.detections[5].box.top_px -= 60.0;
  frame.detections[5].box.bottom_px -= 8.0;
  const ObjectsPitchOutput& output = cue.update(input_of(frame));
  EXPECT_EQ(output.verdicts[5], BoxVerdict::kOutlier);
  EXPECT_EQ(output.num_used, 5);
}

TEST(ObjectsPitch, DistrustsATrackThatDisagreesFrameAfterFrame) {
  // A car stands on a ramp 1.2 m above the road, which is too little for an outlier in one frame.
  ObjectsPitch cue(DetectionsConfig{}, kSceneCamera);
  BoxVerdict last = BoxVerdict::kUsed;
  for (int k = 0; k < 15; ++k) {
    DetectionFrame frame = test::seen(six_cars(), test::road(0.0), 100'000 * k);
    const double lift_px = 721.5 * 0.75 / 30.0;
    frame.detections[2].box.top_px -= lift_px;
    frame.detections[2].box.bottom_px -= lift_px;
    last = cue.update(input_of(frame)).verdicts[2];
  }
  EXPECT_TRUE(last == BoxVerdict::kAgainstPlane || last == BoxVerdict::kOutlier)
      << static_cast<int>(last);
}

TEST(ObjectsPitch, KeepsTheHeightsThatWereMeasuredUnderAKnownPitch) {
  // Cars that are 10 % taller than their class bias the pitch until another cue has shown how tall
  // they are.
  std::vector<test::SceneObject> cars = six_cars();
  for (test::SceneObject& car : cars) car.height_m = 1.68;
  ObjectsPitch cue(DetectionsConfig{}, kSceneCamera);
  double first_error = 0.0;
  for (int k = 0; k < 20; ++k) {
    const DetectionFrame frame = test::seen(cars, test::road(0.0), 100'000 * k);
    ObjectsPitchInput input = input_of(frame);
    input.has_other = true;
    input.other_var_rad2 = std::pow(0.1 * kDegree, 2);
    const double error = std::abs(cue.update(input).n3);
    if (k == 0) first_error = error;
  }
  const DetectionFrame frame = test::seen(cars, test::road(0.6 * kDegree), 2'000'000);
  const ObjectsPitchOutput& output = cue.update(input_of(frame));
  EXPECT_GT(first_error, 0.15 * kDegree);
  EXPECT_NEAR(output.n3, std::sin(0.6 * kDegree), 0.4 * first_error);
  EXPECT_NEAR(output.height_m[0], 1.68, 0.05);
}

TEST(ObjectsPitch, SpreadCandidatesWidenTheDeviation) {
  const auto n3_std = [](double spread_px) {
    DetectionFrame frame = test::seen({{1, 36.0, 0.0}}, test::road(0.0));
    Detection& d = frame.detections[0];
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < kMaxCandidates; ++i) {
      double e2 = 0.0;
      double z[4];
      for (double& value : z) {
        value = normal(random);
        e2 += value * value;
      }
      Candidate candidate{d.box, d.score * std::exp(-0.5 * e2)};
      candidate.box.left_px += spread_px * z[0];
      candidate.box.right_px += spread_px * z[1];
      candidate.box.top_px += spread_px * z[2];
      candidate.box.bottom_px += spread_px * z[3];
      EXPECT_TRUE(d.candidates.push_back(candidate));
    }
    DetectionsConfig config;
    config.car.std_m = 0.02;  // else the height's standard deviation hides the edges'
    ObjectsPitch cue(config, kSceneCamera);
    const ObjectsPitchOutput& output = cue.update(input_of(frame));
    EXPECT_GT(output.confidence_px2[0], 0.0);
    return std::sqrt(output.n3_var);
  };
  EXPECT_GT(n3_std(6.0), 1.2 * n3_std(1.0));
}

TEST(ObjectsPitch, DeviationsAreHonestOverManyScenes) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  double sum = 0.0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<test::SceneObject> cars = six_cars();
    for (test::SceneObject& car : cars) car.height_m = 1.53 + 0.12 * normal(random);
    const double pitch = 0.5 * kDegree * normal(random);
    DetectionFrame frame = test::seen(cars, test::road(pitch));
    test::shake(&frame, 1.5, &random);
    ObjectsPitch cue(DetectionsConfig{}, kSceneCamera);
    const ObjectsPitchOutput& output = cue.update(input_of(frame));
    ASSERT_EQ(output.status, ObjectsPitchStatus::kValid);
    sum += std::pow(output.n3 - std::sin(pitch), 2) / output.n3_var;
  }
  EXPECT_GT(sum / kTrials, 0.4);  // the configured edge noise and common bias are larger than here
  EXPECT_LT(sum / kTrials, 1.3);
}

TEST(ObjectsPitch, SaysNothingWithoutBoxesAndFailsWhenAllContradict) {
  ObjectsPitch cue(DetectionsConfig{}, kSceneCamera);
  const DetectionFrame empty;
  EXPECT_EQ(cue.update(input_of(empty)).status, ObjectsPitchStatus::kAbsent);
  DetectionFrame absurd = test::seen({{1, 30.0, 0.0}}, test::road(0.0), 100'000);
  absurd.detections[0].box.top_px -= 90.0;
  const ObjectsPitchOutput& output = cue.update(input_of(absurd));
  EXPECT_EQ(output.status, ObjectsPitchStatus::kFailed);
  EXPECT_NEAR(output.pitch_rad, 0.0, 0.01 * kDegree);
}

TEST(ObjectsPitch, ForgetsEverythingWhenTimeRunsBackwards) {
  std::vector<test::SceneObject> cars = six_cars();
  for (test::SceneObject& car : cars) car.height_m = 1.68;
  ObjectsPitch cue(DetectionsConfig{}, kSceneCamera);
  for (int k = 10; k < 30; ++k) {
    const DetectionFrame frame = test::seen(cars, test::road(0.0), 100'000 * k);
    ObjectsPitchInput input = input_of(frame);
    input.has_other = true;
    input.other_var_rad2 = 1e-7;
    cue.update(input);
  }
  const DetectionFrame earlier = test::seen(cars, test::road(0.0), 0);
  ObjectsPitch fresh(DetectionsConfig{}, kSceneCamera);
  EXPECT_EQ(cue.update(input_of(earlier)).n3, fresh.update(input_of(earlier)).n3);
}

TEST(ObjectsPitch, HoldsThirtyTwoTracksAndSaysThatItHasNoRoomForMore) {
  DetectionFrame frame;
  for (int i = 0; i < static_cast<int>(kMaxDetections); ++i) {
    Detection d = test::seen_one({i, 40.0, 0.0}, test::road(0.0));
    const double shift_px = -550.0 + 17.0 * i;  // a wide row of slim boxes
    d.box.left_px = kSceneCamera.cx_px + shift_px;
    d.box.right_px = d.box.left_px + 15.0;
    ASSERT_TRUE(frame.detections.push_back(d));
  }
  DetectionsConfig config;
  config.max_lateral_m = 50.0;
  ObjectsPitch cue(config, kSceneCamera);
  const ObjectsPitchOutput& output = cue.update(input_of(frame));
  EXPECT_EQ(output.num_used, 32);
  EXPECT_EQ(std::count(output.verdicts.begin(), output.verdicts.end(), BoxVerdict::kNoRoom), 32);
}

TEST(ObjectsPitch, UntrackedBoxesLeaveNoMemory) {
  std::vector<test::SceneObject> cars = six_cars();
  for (test::SceneObject& car : cars) car.track_id = -1;
  ObjectsPitch cue(DetectionsConfig{}, kSceneCamera);
  for (int k = 0; k < 100; ++k) {
    const DetectionFrame frame = test::seen(cars, test::road(0.2 * kDegree), 100'000 * k);
    const ObjectsPitchOutput& output = cue.update(input_of(frame));
    ASSERT_EQ(output.num_used, 6);
    EXPECT_NEAR(output.n3, std::sin(0.2 * kDegree), 0.05 * kDegree);
  }
}

}  // namespace
}  // namespace plumb
