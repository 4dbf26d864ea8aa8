#include "modules/ground/cues/height_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb {
namespace {

constexpr HeightFilter::Prior kPrior{0.0, 0.01, 3.0, 0.0};
constexpr double kCarVar = 0.08 * 0.08;

TEST(HeightFilter, PitchIsUnknownUntilSomethingMeasuresIt) {
  HeightFilter filter(kPrior);
  filter.predict(0.1);
  EXPECT_GT(filter.pitch_var_rad2(), 0.01);
  filter.update_pitch(0.02, 1e-6);
  EXPECT_NEAR(filter.pitch_rad(), 0.02, 1e-5);
  EXPECT_NEAR(filter.pitch_var_rad2(), 1e-6, 1e-9);
}

TEST(HeightFilter, ABoxGivesThePitchWithTheHeightsDeviation) {
  HeightFilter filter(kPrior);
  filter.predict(0.1);
  const auto place = filter.place_of(7, 1, 0.4, kCarVar, 100);
  ASSERT_TRUE(place.is_new);
  filter.update_box(place.slot, 0.4, 0.01, -0.05, 1e-6);
  EXPECT_NEAR(filter.pitch_rad(), 0.01, 1e-4);
  EXPECT_NEAR(filter.pitch_var_rad2(), 1e-6 + 0.05 * 0.05 * kCarVar, 1e-7);
}

TEST(HeightFilter, AHeightMeasuredUnderAKnownPitchTellsThePitchLater) {
  HeightFilter filter(kPrior);
  const double true_height = 0.4 + 0.08;
  // The object is near, so J is large. The pitch is known from elsewhere.
  for (int frame = 0; frame < 5; ++frame) {
    filter.predict(0.1);
    const auto place = filter.place_of(7, 1, 0.4, kCarVar, 100 * frame);
    const double l = filter.log_height(place.slot);
    filter.update_pitch(0.003, 1e-7);
    filter.update_box(place.slot, l, 0.003 + 0.2 * (true_height - l), -0.2, 1e-6);
  }
  // The object is far, so J is small. Only the box measures the pitch.
  filter.predict(0.1);
  const auto place = filter.place_of(7, 1, 0.4, kCarVar, 600);
  ASSERT_FALSE(place.is_new);
  const double l = filter.log_height(place.slot);
  EXPECT_NEAR(l, true_height, 0.004);
  filter.update_box(place.slot, l, -0.006 + 0.05 * (true_height - l), -0.05, 1e-6);
  EXPECT_NEAR(filter.pitch_rad(), -0.006, 2e-4);
  EXPECT_LT(std::sqrt(filter.pitch_var_rad2()), 0.3 * 0.05 * std::sqrt(kCarVar));
}

TEST(HeightFilter, SlowPitchReturnsToTheCalibratedOne) {
  HeightFilter filter({0.002, 0.01, 3.0, 0.0});
  filter.predict(0.1);
  filter.update_pitch(0.02, 1e-8);
  filter.tie_to_slow_pitch(1e-8);
  EXPECT_NEAR(filter.slow_pitch_rad(), 0.02, 1e-4);
  filter.predict(3.0);
  EXPECT_NEAR(filter.slow_pitch_rad(), 0.002 + 0.018 * std::exp(-1.0), 1e-4);
  filter.predict(100.0);
  EXPECT_NEAR(filter.slow_pitch_rad(), 0.002, 1e-9);
  EXPECT_NEAR(filter.slow_pitch_var_rad2(), 1e-4, 1e-9);
}

TEST(HeightFilter, ANewClassBeginsTheHeightAnew) {
  HeightFilter filter(kPrior);
  filter.predict(0.1);
  const auto car = filter.place_of(7, 1, 0.4, kCarVar, 100);
  const auto van = filter.place_of(7, 2, 0.7, 0.01, 200);
  EXPECT_TRUE(van.is_new);
  EXPECT_EQ(van.slot, car.slot);
  EXPECT_NEAR(filter.log_height(van.slot), 0.7, 1e-12);
}

TEST(HeightFilter, TheLongestUnseenTrackGivesWayAndSeenOnesDoNot) {
  HeightFilter filter(kPrior);
  for (int id = 0; id < static_cast<int>(HeightFilter::kMaxHeights); ++id) {
    ASSERT_TRUE(filter.place_of(id, 1, 0.4, kCarVar, 1000 + id).is_new);
  }
  const auto fifth = filter.place_of(4, 1, 0.4, kCarVar, 2000);
  const auto replaced = filter.place_of(100, 1, 0.4, kCarVar, 2000);
  EXPECT_TRUE(replaced.is_new);
  EXPECT_NE(replaced.slot, fifth.slot);
  EXPECT_EQ(replaced.slot, 0u);
  for (int id = 200; id < 230; ++id) ASSERT_TRUE(filter.place_of(id, 1, 0.4, kCarVar, 2000).is_new);
  EXPECT_EQ(filter.place_of(300, 1, 0.4, kCarVar, 2000).slot, HeightFilter::kNone);
  filter.drop_before(3000);
  EXPECT_TRUE(filter.place_of(300, 1, 0.4, kCarVar, 3000).is_new);
}

}  // namespace
}  // namespace plumb
