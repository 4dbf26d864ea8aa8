#include "modules/mount/height_learner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace plumb {
namespace {

// A car at 10 m/s, ten images a second, whose camera is 1.5 m above the road.
constexpr double kTrueHeight_m = 1.5;
constexpr double kStep_m = 1.0;
constexpr CameraHeight kUnsure{1.65, 0.3};

class HeightLearnerTest : public testing::Test {
 protected:
  /// One more image. The vehicle's speed of the image `lag` images back arrives with it.
  void drive(double distance_m, const CameraHeight& stated, double vehicle_factor = 1.0) {
    for (double m = 0.0; m < distance_m; m += kStep_m) {
      ++index_;
      ground_.capture_us = time_us(index_);
      ground_.ego.road_step_heights = kStep_m / kTrueHeight_m;
      ground_.ego.road_step_ln_var = 1e-4;
      ground_.ego.rate_ground_rad_s.z() = yaw_rate_rad_s_;
      if (speaks_ && !speaks_late_) say_speed(index_, vehicle_factor);
      statuses_.push_back(learner_.update(ground_, stated).status);
      if (speaks_ && speaks_late_) say_speed(index_ - 3, vehicle_factor);
    }
  }
  void say_speed(std::int64_t index, double factor) {
    if (index < 1) return;
    EXPECT_EQ(learner_.take_speed({time_us(index), 10.0 * factor, scale_std_}), nullptr);
  }
  static std::int64_t time_us(std::int64_t index) { return 1'000'000'000 + 100'000 * index; }
  [[nodiscard]] const HeightReport& report() const { return learner_.report(); }

  HeightLearner learner_{MountConfig{}};
  GroundOutput ground_;
  std::int64_t index_ = 0;
  std::vector<HeightStatus> statuses_;  ///< after each image
  bool speaks_ = true;
  bool speaks_late_ = false;
  double scale_std_ = 0.002;
  double yaw_rate_rad_s_ = 0.0;
};

TEST_F(HeightLearnerTest, WithoutAVehicleSpeedTheStatedHeightStays) {
  speaks_ = false;
  drive(500.0, kUnsure);
  EXPECT_EQ(report().status, HeightStatus::kStated);
  EXPECT_NEAR(report().used.height_m, 1.65, 1e-12);
  EXPECT_NEAR(report().used.std_m, 0.3, 1e-12);
  EXPECT_TRUE(std::isnan(report().by_vehicle.height_m));
}

TEST_F(HeightLearnerTest, AnotherStatedHeightHoldsAtOnceUntilOneIsLearned) {
  drive(60.0, kUnsure);
  drive(kStep_m, {1.2, 0.02});
  EXPECT_EQ(report().status, HeightStatus::kLearning);
  EXPECT_EQ(report().used.height_m, 1.2);
  EXPECT_EQ(report().used.std_m, 0.02);
}

TEST_F(HeightLearnerTest, AnotherCameraIsLearnedAnew) {
  drive(300.0, kUnsure);
  EXPECT_EQ(report().status, HeightStatus::kLearned);
  learner_.forget();
  drive(60.0, {1.2, 0.02});
  EXPECT_EQ(report().status, HeightStatus::kLearning);
  EXPECT_EQ(report().used.height_m, 1.2) << "at once, and not at the rate of a learned height";
  EXPECT_TRUE(std::isnan(report().by_vehicle.height_m));
  drive(300.0, kUnsure);
  EXPECT_NEAR(report().by_vehicle.height_m, kTrueHeight_m, 0.01);
}

TEST_F(HeightLearnerTest, LearnsTheHeight) {
  drive(80.0, kUnsure);
  EXPECT_EQ(report().status, HeightStatus::kLearning);
  drive(420.0, kUnsure);
  EXPECT_EQ(report().status, HeightStatus::kLearned);
  EXPECT_NEAR(report().by_vehicle.height_m, kTrueHeight_m, 1e-9);
  EXPECT_NEAR(report().used.height_m, kTrueHeight_m, 0.002) << "the stated 1.65 counts a little";
  EXPECT_LT(report().used.std_m, 0.01);
  EXPECT_GT(report().by_vehicle.std_m, kTrueHeight_m * MountConfig{}.height_bias_std)
      << "what stretches share does not average out";
}

TEST_F(HeightLearnerTest, TheHeightInUseMovesSlowlyAndSaysHowFarItIsOff) {
  double before_m = kUnsure.height_m;
  for (int i = 0; i < 300; ++i) {
    drive(kStep_m, kUnsure);
    const CameraHeight& used = report().used;
    EXPECT_LE(std::abs(std::log(used.height_m / before_m)), 0.02 * 0.1 + 1e-12);
    EXPECT_LE(std::abs(used.height_m - kTrueHeight_m), used.std_m) << i;
    before_m = used.height_m;
  }
}

TEST_F(HeightLearnerTest, ASureStatedHeightIsContradicted) {
  drive(300.0, {1.65, 0.01});
  EXPECT_EQ(report().status, HeightStatus::kContradicted);
  EXPECT_LE(std::abs(report().used.height_m - kTrueHeight_m), 2.0 * report().used.std_m);
  EXPECT_LE(std::abs(report().used.height_m - 1.65), 2.0 * report().used.std_m)
      << "the deviation covers both";
}

TEST_F(HeightLearnerTest, TheErrorThatAllSpeedsShareStaysInTheDeviation) {
  scale_std_ = 0.02;
  drive(1500.0, kUnsure, 1.02);
  EXPECT_NEAR(report().by_vehicle.height_m, 1.02 * kTrueHeight_m, 1e-9);
  EXPECT_GT(report().by_vehicle.std_m, 0.02 * kTrueHeight_m);
}

TEST_F(HeightLearnerTest, LearnsNothingInTurns) {
  yaw_rate_rad_s_ = 0.1;
  drive(300.0, kUnsure);
  EXPECT_EQ(report().num_stretches, 0);
}

TEST_F(HeightLearnerTest, AStretchThatDisagreesIsLeftOut) {
  drive(200.0, kUnsure);
  drive(26.0, kUnsure, 1.5);
  drive(200.0, kUnsure);
  EXPECT_NEAR(report().by_vehicle.height_m, kTrueHeight_m, 0.02 * kTrueHeight_m);
}

TEST_F(HeightLearnerTest, TheOrderOfSpeedsAndImagesDoesNotMatter) {
  drive(300.0, kUnsure);
  const HeightReport early = report();
  const std::vector<HeightStatus> early_statuses = std::exchange(statuses_, {});
  learner_ = HeightLearner{MountConfig{}};
  index_ = 0;
  speaks_late_ = true;
  drive(300.0, kUnsure);
  EXPECT_EQ(statuses_, early_statuses);
  EXPECT_EQ(report().num_stretches, early.num_stretches);
  EXPECT_EQ(report().by_vehicle.height_m, early.by_vehicle.height_m);
  EXPECT_EQ(report().used.height_m, early.used.height_m);
}

}  // namespace
}  // namespace plumb
