#include "modules/vo/road/road_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb::vo {
namespace {

constexpr double kWatchInterval_s = 0.05;
constexpr RoadSpeedEstimate kRoad{true, 20.0, 0.4, 0.6, 0.0};

class RoadWatchTest : public ::testing::Test {
 protected:
  /// Shows images in which VO's step is `unit` times the road's way.
  MotionSource show(int num, double unit, VoStatus status = VoStatus::kOk) {
    for (int i = 0; i < num; ++i) show_once(unit, status, kRoad);
    return watch_.source();
  }
  void show_once(double unit, VoStatus status, const RoadSpeedEstimate& road) {
    VoOutput vo;
    vo.status = status;
    vo.T_prev_cam.t.z() = status == VoStatus::kOk ? unit * kRoad.speed * kWatchInterval_s : 0.0;
    watch_.judge(vo, road, kWatchInterval_s);
  }

  RoadWatch watch_;
};

TEST_F(RoadWatchTest, TrustsFeaturesWhoseRatioIsSteady) {
  EXPECT_EQ(show(200, 0.3), MotionSource::kFeatures);
  EXPECT_TRUE(watch_.knows_unit());
  EXPECT_NEAR(watch_.unit(), 0.3, 1e-9);
}

TEST_F(RoadWatchTest, TrustsFeaturesThatDriftSlowly) {
  for (int i = 0; i < 600; ++i)
    show_once(0.3 * std::exp(0.005 * i * kWatchInterval_s), VoStatus::kOk, kRoad);
  EXPECT_EQ(watch_.source(), MotionSource::kFeatures);
}

TEST_F(RoadWatchTest, TakesTheRoadWhenTheRatioRunsAway) {
  show(40, 0.3);
  EXPECT_EQ(show(60, 0.2), MotionSource::kRoad);
}

TEST_F(RoadWatchTest, TakesTheRoadWhenTheRatioJumpsFromImageToImage) {
  for (int i = 0; i < 60; ++i) show_once(i % 2 == 0 ? 0.25 : 0.3, VoStatus::kOk, kRoad);
  EXPECT_EQ(watch_.source(), MotionSource::kRoad);
}

TEST_F(RoadWatchTest, TakesTheRoadWhenFeaturesStandWhileItPasses) {
  show(40, 0.3);
  EXPECT_EQ(show(5, 0.0, VoStatus::kStandstill), MotionSource::kFeatures);
  EXPECT_EQ(show(10, 0.0, VoStatus::kStandstill), MotionSource::kRoad);
}

TEST_F(RoadWatchTest, BelievesAStandstillWhileNoRoadIsSeen) {
  for (int i = 0; i < 100; ++i) show_once(0.0, VoStatus::kStandstill, {});
  EXPECT_EQ(watch_.source(), MotionSource::kFeatures);
}

TEST_F(RoadWatchTest, TrustsTheFeaturesAgainAfterFiveSteadySeconds) {
  show(40, 0.3);
  show(25, 0.2);
  ASSERT_EQ(watch_.source(), MotionSource::kRoad);
  EXPECT_EQ(show(60, 0.2), MotionSource::kRoad);
  EXPECT_EQ(show(80, 0.2), MotionSource::kFeatures);
}

TEST_F(RoadWatchTest, TrustsTheFeaturesAgainWhenTheRoadWasNotSeenForFiveSeconds) {
  show(40, 0.3);
  show(60, 0.2);
  ASSERT_EQ(watch_.source(), MotionSource::kRoad);
  for (int i = 0; i < 110; ++i) show_once(0.2, VoStatus::kOk, {});
  EXPECT_EQ(watch_.source(), MotionSource::kFeatures);
}

}  // namespace
}  // namespace plumb::vo
