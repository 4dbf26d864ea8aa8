#include "modules/objects/objects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/objects/cuboid_scene.hpp"

namespace plumb {
namespace {

using test::car_at;
using test::kSceneCamera;

constexpr std::int64_t kStep_us = 100'000;

/// Cars with constant velocities around a moving camera.
class Drive {
 public:
  explicit Drive(double camera_speed_m_s = 0.0, double yaw_rate_rad_s = 0.0)
      : speed_m_s_(camera_speed_m_s), yaw_rate_rad_s_(yaw_rate_rad_s) {}

  void add(const StateVector& car, std::int32_t track_id) {
    cars_.push_back(car);
    ids_.push_back(track_id);
  }

  /// Advances by one image and omits the boxes of the cars in `skip`.
  const ObjectsOutput& step(bool knows_motion = true, std::int32_t skip = -100,
                            double noise_px = 0.0) {
    DetectionFrame frame;
    frame.capture_us = k_ * kStep_us;
    frame.seq = k_;
    GroundMotion motion;
    motion.dt_s = k_ == 0 ? 0.0 : 0.1;
    motion.known = knows_motion;
    motion.t_m = {speed_m_s_ * motion.dt_s, 0.0};
    motion.yaw_rad = yaw_rate_rad_s_ * motion.dt_s;
    const double c = std::cos(motion.yaw_rad), s = std::sin(motion.yaw_rad);
    Eigen::Matrix2d R_new_old;
    R_new_old << c, s, -s, c;
    for (std::size_t i = 0; i < cars_.size(); ++i) {
      StateVector& car = cars_[i];
      const Eigen::Vector2d velocity = car.segment<2>(kVelocityX);
      car.head<2>() = R_new_old * (car.head<2>() + motion.dt_s * velocity - motion.t_m);
      car.segment<2>(kVelocityX) = R_new_old * velocity;
      car(kYaw) -= motion.yaw_rad;
      if (ids_[i] == skip || car(kX) < 4.0) continue;
      EXPECT_TRUE(frame.detections.push_back(test::detect(car, kerb(), ids_[i])));
    }
    for (Detection& d : frame.detections) {
      if (!in_the_sky_) continue;
      d.box.bottom_px = 60.0;
      d.box.top_px = d.box.bottom_px - 0.001;
      d.box.right_px = d.box.left_px + 0.001;
    }
    if (noise_px > 0.0) test::shake(&frame, noise_px, &random_);
    ++k_;
    ObjectsInput input;
    input.frame = &frame;
    input.plane = plane_;
    input.plane.cov.diagonal() << 1e-6, 1e-5, 1e-5;
    input.plane_measured = true;
    input.motion = motion;
    return tracker_.update(input);
  }

  [[nodiscard]] const StateVector& car(std::size_t i) const { return cars_[i]; }
  void drive_off(std::size_t i, double speed_m_s) { cars_[i](kVelocityX) = speed_m_s; }
  /// Height of the cars' road above the road of the camera.
  void stand_on(double height_m) { kerb_m_ = height_m; }
  /// Boxes without a size above the horizon, which no object on the road has.
  void hang_in_the_sky(bool hangs) { in_the_sky_ = hangs; }

 private:
  [[nodiscard]] RoadPlane kerb() const {
    RoadPlane raised = plane_;
    raised.height_m -= kerb_m_;
    return raised;
  }

  double speed_m_s_, yaw_rate_rad_s_;
  double kerb_m_ = 0.0;
  bool in_the_sky_ = false;
  RoadPlane plane_ = test::road(0.005);
  std::vector<StateVector> cars_;
  std::vector<std::int32_t> ids_;
  std::int64_t k_ = 0;
  std::mt19937 random_{8};
  ObjectTracker tracker_{DetectionsConfig{}, ObjectsConfig{}, kSceneCamera};
};

StateVector moving(StateVector car, double vx, double vy) {
  car(kVelocityX) = vx;
  car(kVelocityY) = vy;
  return car;
}

TEST(Objects, PlacesACarWithItsSizeAndDeviation) {
  Drive drive;
  drive.add(car_at(18.0, 3.0, 0.0), 5);
  const ObjectsOutput& output = drive.step();
  ASSERT_EQ(output.objects.size(), 1u);
  const ObjectOutput& car = output.objects[0];
  EXPECT_EQ(car.track_id, 5);
  EXPECT_EQ(car.status, ObjectStatus::kMeasured);
  EXPECT_EQ(car.reason, ObjectReason::kNone);
  EXPECT_NEAR(car.position_m.x(), 18.0, 0.3);
  EXPECT_NEAR(car.position_m.y(), 3.0, 0.2);
  EXPECT_NEAR(car.size_m.x(), 4.0, 0.3);
  EXPECT_GT(std::sqrt(car.position_cov_m2(0, 0)), 0.05);
  EXPECT_LT(std::sqrt(car.position_cov_m2(0, 0)), 2.0);
}

TEST(Objects, LongTracksStillDoubtThePlaceAcrossTheLineOfSight) {
  Drive drive(8.0);
  drive.add(car_at(45.0, 6.0, 0.0), 5);
  const ObjectOutput* car = nullptr;
  for (int k = 0; k < 40; ++k) car = &drive.step().objects[0];
  ASSERT_EQ(car->status, ObjectStatus::kMeasured);
  const Eigen::Vector2d across =
      Eigen::Vector2d(-car->position_m.y(), car->position_m.x()).normalized();
  const double std_m = std::sqrt(across.dot(car->position_cov_m2 * across));
  EXPECT_GT(std_m, ObjectsConfig{}.side_std_m);
  EXPECT_LT(std_m, 0.3);
}

TEST(Objects, VelocityIsOverGroundWhileTheCameraDrivesAndTurns) {
  Drive drive(12.0, 0.15);
  drive.add(moving(car_at(25.0, 0.0, 0.0), 14.0, 0.0), 1);
  const ObjectOutput* last = nullptr;
  for (int k = 0; k < 25; ++k) last = &drive.step().objects[0];
  ASSERT_TRUE(last->velocity_valid);
  EXPECT_NEAR(last->velocity_m_s.norm(), 14.0, 1.0);
  const double heading = std::atan2(drive.car(0)(kVelocityY), drive.car(0)(kVelocityX));
  EXPECT_NEAR(last->yaw_rad, heading, 0.15);
  EXPECT_NEAR((last->position_m - drive.car(0).head<2>()).norm(), 0.0, 0.8);
  EXPECT_NEAR(last->age_s, 2.4, 1e-9);
}

TEST(Objects, AParkedCarStandsStillWhileTheCameraPasses) {
  Drive drive(10.0);
  drive.add(car_at(35.0, -4.0, 0.0), 1);
  const ObjectOutput* last = nullptr;
  for (int k = 0; k < 25; ++k) last = &drive.step().objects[0];
  EXPECT_LT(last->velocity_m_s.norm(), 0.8);
  EXPECT_NEAR(last->time_to_collision_s, last->position_m.norm() / 10.0, 0.15);
}

/// A car a tenth higher than its class, whose size alone implies a distance a tenth too short.
StateVector tall(StateVector car) {
  car(kLogHeight) += std::log(1.12);
  return car;
}

TEST(Objects, TheCamerasWayShowsTheDistanceOfWhatStands) {
  // The car is on a pavement, so neither its size nor its foot gives its position.
  double error[2] = {};
  for (const bool knows_motion : {false, true}) {
    Drive drive(10.0);
    drive.stand_on(0.25);
    drive.add(tall(car_at(35.0, -4.0, 0.0)), 1);
    const ObjectOutput* last = nullptr;
    for (int k = 0; k < 25; ++k) last = &drive.step(knows_motion).objects[0];
    const Eigen::Vector2d off = last->position_m - drive.car(0).head<2>();
    error[knows_motion ? 1 : 0] = off.norm();
    EXPECT_LT(off.dot(last->position_cov_m2.inverse() * off), 12.0);
    if (knows_motion) {
      EXPECT_LT(last->velocity_m_s.norm(), 0.05);
    }
  }
  EXPECT_LT(error[1], 0.6);
  EXPECT_GT(error[0], 2.0 * error[1]);
}

TEST(Objects, BoxesThatFitNoObjectLeaveATrackAsItWas) {
  Drive drive(10.0);
  drive.add(car_at(45.0, -4.0, 0.0), 1);
  for (int k = 0; k < 20; ++k) drive.step();
  drive.hang_in_the_sky(true);
  for (int k = 0; k < 6; ++k) {
    const ObjectOutput& seen = drive.step().objects[0];
    ASSERT_EQ(seen.status, ObjectStatus::kPredicted) << k;
    EXPECT_EQ(seen.reason, ObjectReason::kMisfit);
    EXPECT_LT((seen.position_m - drive.car(0).head<2>()).norm(), 0.5) << k;
    EXPECT_LT(seen.velocity_cov_m2_s2(0, 0), 0.25) << k << ": the car still stands";
  }
}

TEST(Objects, SlowTrafficIsNotTakenForParked) {
  for (const double speed_m_s : {-2.0, 2.0, 4.0}) {
    Drive drive(10.0);
    drive.add(moving(car_at(40.0, 0.0, 0.0), speed_m_s, 0.0), 1);
    for (int k = 0; k < 24; ++k) {
      const ObjectOutput& seen = drive.step(true, -100, 0.5).objects[0];
      if (k <= 15) continue;
      const double std_m_s = std::sqrt(seen.velocity_cov_m2_s2(0, 0));
      EXPECT_NEAR(seen.velocity_m_s.x(), speed_m_s, 4.0 * std_m_s) << speed_m_s << " at " << k;
      if (k == 23) {
        EXPECT_NEAR(seen.velocity_m_s.x(), speed_m_s, 1.2);
      }
    }
  }
}

TEST(Objects, ACarThatMovesOffIsNoLongerParked) {
  Drive drive(0.0);
  drive.add(car_at(15.0, 0.0, 0.0), 1);
  for (int k = 0; k < 20; ++k) drive.step();
  EXPECT_LT(drive.step().objects[0].velocity_m_s.norm(), 0.5);
  drive.drive_off(0, 3.0);
  const ObjectOutput* last = nullptr;
  for (int k = 0; k < 15; ++k) last = &drive.step().objects[0];
  EXPECT_NEAR(last->velocity_m_s.x(), 3.0, 1.2);
  EXPECT_NEAR(last->position_m.x(), drive.car(0)(kX), 1.5);
}

TEST(Objects, OncomingTrafficHeadsTowardsUs) {
  Drive drive(10.0);
  drive.add(moving(car_at(60.0, 4.0, std::numbers::pi), -10.0, 0.0), 1);
  const ObjectOutput* last = nullptr;
  for (int k = 0; k < 20; ++k) last = &drive.step().objects[0];
  EXPECT_NEAR(last->velocity_m_s.x(), -10.0, 1.5);
  EXPECT_GT(std::abs(last->yaw_rad), 2.9);
  EXPECT_NEAR(last->time_to_collision_s, 22.0 / 20.0, 0.3);
}

TEST(Objects, ACarThatPullsAwayHasNoTimeToCollision) {
  Drive drive(5.0);
  drive.add(moving(car_at(15.0, 0.0, 0.0), 12.0, 0.0), 1);
  for (int k = 0; k < 10; ++k) drive.step();
  EXPECT_TRUE(std::isnan(drive.step().objects[0].time_to_collision_s));
}

TEST(Objects, VelocityDoesNotHoldWhileTheCamerasMotionIsUnknown) {
  Drive drive(10.0);
  drive.add(car_at(35.0, -4.0, 0.0), 1);
  for (int k = 0; k < 15; ++k) EXPECT_FALSE(drive.step(false).objects[0].velocity_valid);
  const ObjectOutput relative = drive.step(false).objects[0];
  EXPECT_NEAR(relative.velocity_m_s.x(), -10.0, 2.5);
  EXPECT_NEAR(relative.time_to_collision_s, relative.position_m.norm() / 10.0, 0.4);
}

TEST(Objects, CoastsWithGrowingDeviationThenEnds) {
  Drive drive(10.0);
  drive.add(moving(car_at(20.0, 0.0, 0.0), 10.0, 0.0), 1);
  for (int k = 0; k < 10; ++k) drive.step();
  double variance = 0.0;
  for (int k = 0; k < 10; ++k) {
    const ObjectsOutput& output = drive.step(true, 1);
    ASSERT_EQ(output.objects.size(), 1u);
    EXPECT_EQ(output.objects[0].status, ObjectStatus::kPredicted);
    EXPECT_EQ(output.objects[0].reason, ObjectReason::kNotSeen);
    EXPECT_GT(output.objects[0].position_cov_m2(0, 0), variance);
    variance = output.objects[0].position_cov_m2(0, 0);
  }
  EXPECT_EQ(drive.step(true, 1).objects.size(), 0u);
}

TEST(Objects, FollowsBoxesWithoutNumbersByOverlap) {
  Drive drive(8.0);
  drive.add(moving(car_at(20.0, 3.0, 0.0), 8.0, 0.0), -1);
  drive.add(moving(car_at(24.0, -3.0, 0.0), 8.0, 0.0), -1);
  const ObjectsOutput first = drive.step();
  ASSERT_EQ(first.objects.size(), 2u);
  EXPECT_GE(first.objects[0].track_id, ObjectTracker::kFirstOwnId);
  EXPECT_NE(first.objects[0].track_id, first.objects[1].track_id);
  for (int k = 0; k < 10; ++k) {
    const ObjectsOutput& output = drive.step();
    ASSERT_EQ(output.objects.size(), 2u);
    EXPECT_EQ(output.objects[0].track_id, first.objects[0].track_id);
    EXPECT_EQ(output.objects[1].track_id, first.objects[1].track_id);
  }
}

TEST(Objects, KeepsTheNearestWhenThereAreMoreThanItHolds) {
  Drive drive;
  // The far objects come first, and nearer ones replace them.
  for (int i = 0; i < 40; ++i) drive.add(car_at(64.0 - i, -24.0 + 1.2 * i, 0.0), i);
  const ObjectsOutput& output = drive.step();
  EXPECT_EQ(output.objects.size(), kMaxObjects);
  EXPECT_EQ(output.num_refused, 8);
  for (std::size_t i = 0; i < output.objects.size(); ++i) {
    EXPECT_GE(output.objects[i].track_id, 8);
    if (i > 0) {
      EXPECT_GE(output.objects[i].position_m.norm(), output.objects[i - 1].position_m.norm());
    }
  }
}

TEST(Objects, SaysWhyAMeasurementIsWeaker) {
  Drive cut;
  cut.add(car_at(7.0, 4.5, 0.0), 1);
  EXPECT_EQ(cut.step().objects[0].reason, ObjectReason::kCut);
  Drive hidden;
  hidden.add(car_at(30.0, 0.3, 0.0), 1);
  hidden.add(car_at(18.0, 0.0, 0.0), 2);
  const ObjectsOutput& output = hidden.step();
  EXPECT_EQ(output.objects[0].reason, ObjectReason::kNone);
  EXPECT_EQ(output.objects[1].reason, ObjectReason::kHidden);
}

TEST(Objects, ABoxInTheSkyIsNamedAsNotLocalisedNotPlacedSomewhere) {
  ObjectTracker tracker(DetectionsConfig{}, ObjectsConfig{}, kSceneCamera);
  DetectionFrame frame;
  Detection detection = test::detect(car_at(20.0, 0.0, 0.0), test::road(0.0), 3);
  detection.box.top_px = detection.box.bottom_px = 60.0;
  detection.box.top_px -= 0.001;  // no object is this low
  detection.box.right_px = detection.box.left_px + 0.001;
  ASSERT_TRUE(frame.detections.push_back(detection));
  ObjectsInput input;
  input.frame = &frame;
  input.plane = test::road(0.0);
  const ObjectsOutput& output = tracker.update(input);
  ASSERT_EQ(output.objects.size(), 1u);
  EXPECT_EQ(output.objects[0].status, ObjectStatus::kNotLocalised);
  EXPECT_EQ(output.objects[0].reason, ObjectReason::kNoFit);
}

TEST(Objects, DeviationsAreHonestUnderNoise) {
  double sum = 0.0;
  int count = 0;
  for (int run = 0; run < 10; ++run) {
    Drive drive(10.0);
    for (int i = 0; i < 6; ++i) {
      drive.add(moving(car_at(20.0 + 6.0 * i, -8.0 + 3.0 * i, 0.02 * run), 10.0, 0.0), i);
    }
    for (int k = 0; k < 15; ++k) {
      const ObjectsOutput& output = drive.step(true, -100, 1.5);
      for (const ObjectOutput& object : output.objects) {
        const Eigen::Vector2d off =
            object.position_m - drive.car(static_cast<std::size_t>(object.track_id)).head<2>();
        const Eigen::Matrix2d& P = object.position_cov_m2;
        const double determinant = P(0, 0) * P(1, 1) - P(0, 1) * P(1, 0);
        sum += (P(1, 1) * off.x() * off.x() - 2.0 * P(0, 1) * off.x() * off.y() +
                P(0, 0) * off.y() * off.y()) /
               determinant / 2.0;
        ++count;
      }
    }
  }
  // The sizes are the mean of the class here, so errors are smaller than the filter assumes.
  EXPECT_LT(sum / count, 1.5);
  EXPECT_GT(sum / count, 0.05);
}

TEST(Objects, AreTheSameFromRunToRun) {
  Drive a(10.0), b(10.0);
  for (Drive* drive : {&a, &b}) {
    drive->add(moving(car_at(20.0, 3.0, 0.0), 8.0, 0.0), 1);
    drive->add(moving(car_at(26.0, -3.0, 0.0), 12.0, 0.0), -1);
  }
  for (int k = 0; k < 20; ++k) {
    const ObjectsOutput first = a.step(true, -100, 1.0);
    const ObjectsOutput& second = b.step(true, -100, 1.0);
    ASSERT_EQ(first.objects.size(), second.objects.size());
    for (std::size_t i = 0; i < first.objects.size(); ++i) {
      EXPECT_EQ(first.objects[i].position_m, second.objects[i].position_m);
      EXPECT_EQ(first.objects[i].velocity_m_s, second.objects[i].velocity_m_s);
    }
  }
}

}  // namespace
}  // namespace plumb
