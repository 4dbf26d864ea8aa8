#include "modules/detector/suppress.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb {
namespace {

RawBox car(double left, double top, double right, double bottom, double score) {
  return {{left, top, right, bottom}, score, ObjectClass::kCar};
}

TEST(IntersectionOverUnion, IsSharedOverCommonArea) {
  EXPECT_DOUBLE_EQ(intersection_over_union({0, 0, 10, 10}, {0, 0, 10, 10}), 1.0);
  EXPECT_DOUBLE_EQ(intersection_over_union({0, 0, 10, 10}, {5, 0, 15, 10}), 50.0 / 150.0);
  EXPECT_DOUBLE_EQ(intersection_over_union({0, 0, 10, 10}, {10, 0, 20, 10}), 0.0);
}

TEST(Suppress, KeepsTheBestAndWhatAgreesAsItsCandidates) {
  std::vector<RawBox> raw = {car(1, 0, 11, 10, 0.5), car(0, 0, 10, 10, 0.9),
                             car(100, 0, 120, 20, 0.7), car(0, 1, 10, 11, 0.4)};
  DetectionFrame frame;
  suppress(&raw, 0.5, &frame);
  ASSERT_EQ(frame.detections.size(), 2U);
  const Detection& best = frame.detections[0];
  EXPECT_EQ(best.score, 0.9);
  EXPECT_EQ(best.track_id, -1);
  EXPECT_TRUE(std::isnan(best.truncated_ratio));
  ASSERT_EQ(best.candidates.size(), 3U);
  EXPECT_EQ(best.candidates[0].score, 0.9);
  EXPECT_EQ(best.candidates[1].score, 0.5);
  EXPECT_EQ(best.candidates[2].score, 0.4);
  EXPECT_EQ(frame.detections[1].candidates.size(), 1U);
}

TEST(Suppress, AnotherClassIsAnotherObject) {
  std::vector<RawBox> raw = {car(0, 0, 10, 10, 0.9), car(0, 0, 10, 10, 0.8)};
  raw[1].object_class = ObjectClass::kTruck;
  DetectionFrame frame;
  suppress(&raw, 0.5, &frame);
  EXPECT_EQ(frame.detections.size(), 2U);
}

TEST(Suppress, LeavesOutWhatDoesNotFit) {
  std::vector<RawBox> raw;
  for (int i = 0; i < 100; ++i)
    raw.push_back(car(20.0 * i, 0, 20.0 * i + 10.0, 10, 0.5 + 0.001 * i));
  for (int i = 0; i < 40; ++i) raw.push_back(car(1980, 0, 1990, 10, 0.1));
  DetectionFrame frame;
  suppress(&raw, 0.5, &frame);
  EXPECT_EQ(frame.detections.size(), kMaxDetections);
  EXPECT_DOUBLE_EQ(frame.detections[0].score, 0.5 + 0.099);
  EXPECT_EQ(frame.detections[0].candidates.size(), kMaxCandidates);
}

}  // namespace
}  // namespace plumb
