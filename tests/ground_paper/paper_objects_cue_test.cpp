#include "modules/ground_paper/paper_objects_cue.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "modules/ground_paper/paper_cues.hpp"
#include "tests/ground_paper/car_boxes.hpp"

namespace plumb {
namespace {

constexpr double kCarPitch = 0.02;

/// Sixteen candidates around the box whose scores fall off as a Gaussian of these 1-sigmas.
void add_candidates(double foot_std_px, double height_std_px, Detection* car) {
  const Box at = car->box;
  for (int k = 0; k < 16; ++k) {
    const double foot_px = foot_std_px * 1.2 * std::sin(1.7 * k);
    const double height_px = height_std_px * 1.2 * std::cos(2.9 * k);
    const double side_px = 0.6 * std::sin(4.1 * k);
    Candidate candidate;
    candidate.box = {at.left_px + side_px, at.top_px + foot_px - height_px,
                     at.right_px + side_px + 0.4 * std::cos(5.3 * k), at.bottom_px + foot_px};
    candidate.score = 0.9 * std::exp(-0.5 * (std::pow(foot_px / foot_std_px, 2) +
                                             std::pow(height_px / height_std_px, 2)));
    (void)car->candidates.push_back(candidate);
  }
}

DetectionFrame one_car(double foot_std_px, double height_std_px) {
  DetectionFrame frame = test::cars_at_pitch(test::scene_camera(), kCarPitch, {20.0});
  add_candidates(foot_std_px, height_std_px, &frame.detections[0]);
  return frame;
}

TEST(PaperObjectsCue, FindsThePitchFromEveryObjectAlone) {
  const CameraModel camera = test::scene_camera();
  PaperObjectsCue cue(DetectionsConfig{}, camera, 0.0);
  DetectionFrame frame = test::cars_at_pitch(camera, kCarPitch, {12.0, 18.0, 28.0});
  const PaperObjects objects = cue.measure(frame, test::kRoadHeight);
  ASSERT_EQ(objects.size(), 3U);
  for (const PaperObject& object : objects) {
    EXPECT_NEAR(object.n3, std::sin(kCarPitch), 1e-6);
    EXPECT_TRUE(std::isnan(object.confidence_px2));
  }
  // A car that is taller than its class looks as if the camera were pitched further down, and no
  // other object mends that: the published cue has no track and no vote.
  frame.detections[1] = test::car_at(camera, kCarPitch, 18.0, -2.0, 1.8);
  const PaperObjects& again = cue.measure(frame, test::kRoadHeight);
  EXPECT_GT(again[1].n3, std::sin(kCarPitch) + 0.005);
  EXPECT_NEAR(again[0].n3, std::sin(kCarPitch), 1e-6);
}

TEST(PaperObjectsCue, LeavesOutWhatIsCutOrWithoutAKnownHeight) {
  const CameraModel camera = test::scene_camera();
  PaperObjectsCue cue(DetectionsConfig{}, camera, 0.0);
  DetectionFrame frame = test::cars_at_pitch(camera, kCarPitch, {12.0, 18.0, 28.0});
  frame.detections[0].truncated_ratio = 0.5;
  frame.detections[1].object_class = ObjectClass::kUnknown;
  const PaperObjects& objects = cue.measure(frame, test::kRoadHeight);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].index, 2U);
}

TEST(PaperObjectsCue, IsMoreConfidentWhereScoresFallOffFaster) {
  PaperObjectsCue cue(DetectionsConfig{}, test::scene_camera(), 0.0);
  const double sharp = cue.measure(one_car(1.0, 1.5), test::kRoadHeight)[0].confidence_px2;
  const double vague = cue.measure(one_car(4.0, 6.0), test::kRoadHeight)[0].confidence_px2;
  // a_d = s_y s_h / (s_y + s_h) of the variances 1 and 2.25.
  EXPECT_NEAR(sharp, 2.25 / 3.25, 0.25);
  EXPECT_GT(vague, 5.0 * sharp);
}

TEST(PaperObjectsCue, GivesEachObjectAVarianceOfItsOwn) {
  PaperVariances variances;
  variances.model.objects_n3 = {1e-5, 1e-5, 1e-5, 1e-3, 7e-5};
  PaperObjects objects;
  (void)objects.push_back({0, 0.02, 3.0, {}});
  (void)objects.push_back({1, 0.01, kNan, {}});
  CueFusion fused;
  const Eigen::Matrix3d still = Eigen::Matrix3d::Identity();
  const CueReport report = add_objects(objects, still, variances, &fused);
  const double information = 1.0 / 4e-5 + 1.0 / 7e-5;
  EXPECT_DOUBLE_EQ(fused.var(kN3), 1.0 / information);
  EXPECT_NEAR(fused.value(kN3), (0.02 / 4e-5 + 0.01 / 7e-5) / information, 1e-12);
  EXPECT_DOUBLE_EQ(report.n3, fused.value(kN3));
  variances.fixed = true;
  CueFusion fixed;
  (void)add_objects(objects, still, variances, &fixed);
  EXPECT_DOUBLE_EQ(fixed.var(kN3), 0.5 * 7e-5);
}

TEST(PaperObjectsCue, TurnsThePitchToTheNewestImage) {
  PaperVariances variances;
  variances.model.objects_n3 = {1e-5, 0.0, 1e-5, 1e-5, 1e-5};
  PaperObjects objects;
  (void)objects.push_back({0, std::sin(0.02), kNan, {}});
  CueFusion fused;
  // The nose dips by 0.01 rad between the images: about cam's x, by the other sign.
  const Eigen::Matrix3d R_newest_due = exp_so3({0.01, 0.0, 0.0});
  (void)add_objects(objects, R_newest_due, variances, &fused);
  EXPECT_NEAR(fused.value(kN3), std::sin(0.03), 1e-9);
}

TEST(PaperObjectsCue, IsOnlyAPartOfAllCues) {
  CueFusion fused;
  const CueReport report = add_objects({}, Eigen::Matrix3d::Identity(), PaperVariances{}, &fused);
  EXPECT_EQ(report.status, CueStatus::kAbsent);
  EXPECT_FALSE(fused.observes(kN3));
}

}  // namespace
}  // namespace plumb
