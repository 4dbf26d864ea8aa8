#include "modules/detections/box_screen.hpp"

#include <gtest/gtest.h>

#include "tests/detections/road_scene.hpp"

namespace plumb {
namespace {

using test::kSceneCamera;

RoadPlane expectation() {
  RoadPlane plane = test::road(0.0);
  plane.cov(0, 0) = 1e-4;
  return plane;
}

BoxVerdict verdict_of(const DetectionFrame& frame, std::size_t index = 0) {
  Verdicts verdicts{};
  screen_boxes(DetectionsConfig{}, kSceneCamera, expectation(), frame, &verdicts);
  return verdicts[index];
}

DetectionFrame one_car() { return test::seen({{1, 20.0, 0.0}}, test::road(0.0)); }

TEST(BoxScreen, UsesAWholeVisibleCarOnTheRoad) {
  EXPECT_EQ(verdict_of(one_car()), BoxVerdict::kUsed);
}

TEST(BoxScreen, RefusesAClassWithoutAHeight) {
  DetectionFrame frame = one_car();
  frame.detections[0].object_class = ObjectClass::kUnknown;
  EXPECT_EQ(verdict_of(frame), BoxVerdict::kClassUnknown);
}

TEST(BoxScreen, RefusesALowScore) {
  DetectionFrame frame = one_car();
  frame.detections[0].score = 0.1;
  EXPECT_EQ(verdict_of(frame), BoxVerdict::kLowScore);
}

TEST(BoxScreen, RefusesASmallBox) {
  DetectionFrame frame = one_car();
  frame.detections[0].box.top_px = frame.detections[0].box.bottom_px - 8.0;
  EXPECT_EQ(verdict_of(frame), BoxVerdict::kTooSmall);
}

TEST(BoxScreen, RefusesACutBoxWhetherTheDetectorSaysSoOrTheBorderDoes) {
  DetectionFrame said = one_car();
  said.detections[0].truncated_ratio = 0.3;
  EXPECT_EQ(verdict_of(said), BoxVerdict::kTruncated);
  for (int side = 0; side < 4; ++side) {
    DetectionFrame cut = one_car();
    Box& box = cut.detections[0].box;
    if (side == 0) box.left_px = 0.0;
    if (side == 1) box.top_px = 1.0;
    if (side == 2) box.right_px = 1241.0;
    if (side == 3) box.bottom_px = 373.5;
    EXPECT_EQ(verdict_of(cut), BoxVerdict::kTruncated) << side;
  }
}

TEST(BoxScreen, RefusesAHiddenCarWhetherTheDetectorSaysSoOrANearerBoxCoversIt) {
  DetectionFrame said = one_car();
  said.detections[0].occluded = Occlusion::kLargely;
  EXPECT_EQ(verdict_of(said), BoxVerdict::kOccluded);
  const DetectionFrame queue = test::seen({{1, 30.0, 0.0}, {2, 20.0, 0.2}}, test::road(0.0));
  EXPECT_EQ(verdict_of(queue, 0), BoxVerdict::kOccluded);
  EXPECT_EQ(verdict_of(queue, 1), BoxVerdict::kUsed);
}

TEST(BoxScreen, MeasuresWhichEdgesAreHidden) {
  // A pedestrian hides a fifth of the van's lower edge but, being lower, nothing of its upper edge.
  DetectionFrame frame;
  Detection van, walker;
  van.box = {100.0, 100.0, 200.0, 200.0};
  walker.box = {120.0, 130.0, 140.0, 220.0};
  ASSERT_TRUE(frame.detections.push_back(van) && frame.detections.push_back(walker));
  EXPECT_DOUBLE_EQ(hidden_edges(frame, 0).lower_ratio, 0.2);
  EXPECT_DOUBLE_EQ(hidden_edges(frame, 0).upper_ratio, 0.0);
  EXPECT_DOUBLE_EQ(hidden_edges(frame, 1).lower_ratio, 0.0);
  frame.detections[1].box.top_px = 90.0;
  EXPECT_DOUBLE_EQ(hidden_edges(frame, 0).upper_ratio, 0.2);
}

TEST(BoxScreen, RefusesWhatStandsAboveTheHorizonFarOffOrAside) {
  DetectionFrame high = one_car();
  high.detections[0].box.top_px -= 100.0;
  high.detections[0].box.bottom_px -= 100.0;
  EXPECT_EQ(verdict_of(high), BoxVerdict::kOffRoad);
  EXPECT_EQ(verdict_of(test::seen({{1, 30.0, 24.0}}, test::road(0.0))), BoxVerdict::kOffRoad);
  const test::SceneObject far_truck{1, 200.0, 0.0, 4.5, ObjectClass::kTruck, 2.5};
  EXPECT_EQ(verdict_of(test::seen({far_truck}, test::road(0.0))), BoxVerdict::kOffRoad);
}

}  // namespace
}  // namespace plumb
