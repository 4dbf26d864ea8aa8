#include "modules/integrity/plausibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace plumb {
namespace {

using Reason = PlausibilityReason;
constexpr double kInterval = 0.1;

/// A drive at 13 m/s on which every figure agrees with every other.
class Drive {
 public:
  VehicleMotion next(double speed_m_s, double yaw_rate_rad_s = 0.0) {
    VehicleMotion m;
    m.interval_s = kInterval;
    m.speed_m_s = speed_m_s;
    m.accel_m_s2 = std::isnan(last_) ? kNan : (speed_m_s - last_) / kInterval;
    m.yaw_rate_rad_s = yaw_rate_rad_s;
    m.step_m = std::abs(speed_m_s) * kInterval;
    m.turn_rad = yaw_rate_rad_s * kInterval;
    distance_ += m.step_m;
    m.distance_m = distance_;
    m.log_scale = 0.3;
    m.height_m = 1.65;
    m.pitch_rad = 0.01;
    m.roll_rad = 0.0;
    last_ = speed_m_s;
    return m;
  }

 private:
  double last_ = kNan;
  double distance_ = 0.0;
};

class PlausibilityTest : public testing::Test {
 protected:
  void drive(int count) {
    for (int i = 0; i < count; ++i) (void)judge_.update(drive_.next(13.0));
  }
  Reason speed(double value) { return judge_.update(drive_.next(value))[VehicleSignal::kSpeed]; }

  Drive drive_;
  Plausibility judge_{PlausibilityConfig{}};
};

TEST_F(PlausibilityTest, EverySignalOfASteadyDriveIsValidFromTheThirdImageOn) {
  for (int i = 0; i < 100; ++i) {
    const PlausibilityVerdict verdict = judge_.update(drive_.next(13.0, 0.2));
    for (std::size_t s = 0; s < kNumVehicleSignals; ++s) {
      const auto signal = static_cast<VehicleSignal>(s);
      if (i >= 2) {
        EXPECT_EQ(verdict[signal], Reason::kNone) << i << " signal " << s;
      }
    }
    EXPECT_FALSE(verdict.must_reset);
  }
}

TEST_F(PlausibilityTest, HardDrivingIsPlausible) {
  drive(5);
  double v = 13.0;
  for (; v > 0.0; v -= 1.0) EXPECT_EQ(speed(v), Reason::kNone) << v;  // 10 m/s2
  for (; v < 30.0; v += 0.6) EXPECT_EQ(speed(v), Reason::kNone) << v;
  Drive turning;
  judge_.reset();
  for (int i = 0; i < 40; ++i) {
    const auto verdict = judge_.update(turning.next(8.0, std::min(0.9, 0.1 * i)));
    if (i >= 2) {
      EXPECT_TRUE(verdict.is_valid(VehicleSignal::kYawRate)) << i;
    }
  }
}

TEST_F(PlausibilityTest, RangesAreRefused) {
  const auto after_drive = [&](const std::function<void(VehicleMotion*)>& change) {
    judge_.reset();
    drive_ = Drive();
    drive(5);
    VehicleMotion m = drive_.next(13.0);
    change(&m);
    return judge_.update(m);
  };
  for (const double bad : {300.0, -300.0, 1e9, kInf}) {
    const auto verdict = after_drive([&](VehicleMotion* m) {
      m->speed_m_s = bad;
      m->step_m = std::abs(bad) * kInterval;
    });
    EXPECT_EQ(verdict[VehicleSignal::kAcceleration], Reason::kDependent) << bad;
    EXPECT_FALSE(verdict.is_valid(VehicleSignal::kSpeed)) << bad;
    EXPECT_FALSE(verdict.is_valid(VehicleSignal::kPose)) << bad;
    EXPECT_TRUE(verdict.is_valid(VehicleSignal::kHeight)) << bad;
  }
  for (const double bad : {0.0, -1.65, 0.05, 12.0, kInf}) {
    const auto verdict = after_drive([&](VehicleMotion* m) { m->height_m = bad; });
    EXPECT_EQ(verdict[VehicleSignal::kHeight], Reason::kOutOfRange) << bad;
    EXPECT_TRUE(verdict.is_valid(VehicleSignal::kSpeed)) << bad;
  }
  const auto verdict = after_drive([](VehicleMotion* m) {
    m->pitch_rad = -0.6;
    m->roll_rad = 3.1;
    m->accel_m_s2 = 127.0;
    m->yaw_rate_rad_s = 1.2;  // 15.6 m/s2 of lateral acceleration
    m->turn_rad = 0.12;
  });
  for (const auto signal : {VehicleSignal::kPitch, VehicleSignal::kRoll, VehicleSignal::kYawRate,
                            VehicleSignal::kAcceleration})
    EXPECT_EQ(verdict[signal], Reason::kOutOfRange) << static_cast<int>(signal);
}

TEST_F(PlausibilityTest, WhatIsNotMeasuredIsNotAvailable) {
  drive(5);
  const auto verdict = judge_.update({.interval_s = kInterval});
  for (std::size_t s = 0; s < kNumVehicleSignals; ++s)
    EXPECT_EQ(verdict[static_cast<VehicleSignal>(s)], Reason::kNotMeasured) << s;
}

TEST_F(PlausibilityTest, ADoubtfulIntervalMakesNoSpeed) {
  for (const double bad : {kNan, 1e-6, 100.0, -0.1, 0.0}) {
    judge_.reset();
    drive_ = Drive();
    drive(5);
    VehicleMotion m = drive_.next(13.0);
    m.interval_s = bad;
    const auto verdict = judge_.update(m);
    EXPECT_EQ(verdict[VehicleSignal::kSpeed], Reason::kInterval) << bad;
    EXPECT_EQ(verdict[VehicleSignal::kYawRate], Reason::kInterval) << bad;
    EXPECT_TRUE(verdict.is_valid(VehicleSignal::kPitch)) << bad;
  }
}

TEST_F(PlausibilityTest, ContradictionsAreNamed) {
  drive(5);
  VehicleMotion m = drive_.next(13.0);
  m.step_m = 0.4;  // 4 m/s
  EXPECT_EQ(judge_.update(m)[VehicleSignal::kSpeed], Reason::kInconsistent);
  drive(5);
  m = drive_.next(13.0);
  m.turn_rad = 0.05;
  EXPECT_EQ(judge_.update(m)[VehicleSignal::kYawRate], Reason::kInconsistent);
  drive(5);
  m = drive_.next(13.0);
  m.distance_m += 20.0;
  EXPECT_EQ(judge_.update(m)[VehicleSignal::kPose], Reason::kInconsistent);
  drive(5);
  m = drive_.next(13.0);
  m.log_scale += 0.6;
  EXPECT_EQ(judge_.update(m)[VehicleSignal::kSpeed], Reason::kTooFast);
}

TEST_F(PlausibilityTest, AResetMayJump) {
  drive(5);
  VehicleMotion m = drive_.next(13.0);
  m.distance_m = 0.0;
  m.log_scale = -1.0;
  m.is_reset = true;
  EXPECT_TRUE(judge_.update(m).is_valid(VehicleSignal::kPose));
}

TEST_F(PlausibilityTest, ASpikeCostsTheSpikeAndTheImagesOfRecovery) {
  for (const double spike : {0.0, 57.0, -9.0, 27.0, 8.0}) {
    judge_.reset();
    drive_ = Drive();
    drive(10);
    EXPECT_EQ(speed(spike), Reason::kTooFast) << spike;
    EXPECT_EQ(speed(13.0), Reason::kRecovering) << spike;
    EXPECT_EQ(speed(13.0), Reason::kRecovering) << spike;
    EXPECT_EQ(speed(13.0), Reason::kNone) << spike;
  }
}

/// The values that follow a refused one agree with it alone.
TEST_F(PlausibilityTest, AgreeingWithARefusedValueIsNotEnough) {
  for (const double wrong : {57.0, 38.0, 0.0, 25.0}) {
    judge_.reset();
    drive_ = Drive();
    drive(10);
    for (int i = 0; i < 11; ++i) EXPECT_NE(speed(wrong), Reason::kNone) << wrong << " " << i;
    EXPECT_EQ(speed(13.0), Reason::kRecovering) << wrong;
    EXPECT_EQ(speed(13.0), Reason::kRecovering) << wrong;
    EXPECT_EQ(speed(13.0), Reason::kNone) << wrong;
  }
}

TEST_F(PlausibilityTest, ASteadyNewValueIsBelievedWithinOneAndAHalfSecondsAndResets) {
  drive(10);
  int images = 0;
  PlausibilityVerdict verdict;
  do {
    verdict = judge_.update(drive_.next(30.0));
    ++images;
  } while (!verdict.is_valid(VehicleSignal::kSpeed) && images < 100);
  EXPECT_GT(images, 10);
  EXPECT_LE(images, 15);
  EXPECT_TRUE(verdict.must_reset);
}

TEST_F(PlausibilityTest, AlternatingValuesAreNeverBelieved) {
  drive(10);
  for (int i = 0; i < 100; ++i) {
    const Reason reason = speed(i % 2 == 0 ? 22.0 : -9.0);
    EXPECT_NE(reason, Reason::kNone) << i;
  }
}

TEST_F(PlausibilityTest, AfterADropOutTheValueOfBeforeIsBelievedAgain) {
  drive(10);
  for (int i = 0; i < 8; ++i) (void)judge_.update({.interval_s = kInterval});
  EXPECT_EQ(speed(12.0), Reason::kRecovering);
  EXPECT_EQ(speed(12.0), Reason::kRecovering);
  EXPECT_EQ(speed(12.0), Reason::kNone);
}

/// After random faults of every signal, a sound drive is valid again within 1.5 s.
TEST_F(PlausibilityTest, NothingIsLostForEver) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> any(-100.0, 100.0);
  for (int round = 0; round < 300; ++round) {
    judge_.reset();
    drive(static_cast<int>(random() % 10));
    const int faults = static_cast<int>(random() % 30);
    for (int i = 0; i < faults; ++i) {
      VehicleMotion m = drive_.next(13.0);
      for (double* field : {&m.interval_s, &m.speed_m_s, &m.yaw_rate_rad_s, &m.step_m, &m.turn_rad,
                            &m.distance_m, &m.log_scale, &m.height_m, &m.pitch_rad, &m.roll_rad})
        if (random() % 3 == 0) *field = random() % 4 == 0 ? kNan : any(random);
      (void)judge_.update(m);
    }
    PlausibilityVerdict verdict;
    for (int i = 0; i < 15; ++i) verdict = judge_.update(drive_.next(13.0));
    for (std::size_t s = 0; s < kNumVehicleSignals; ++s) {
      EXPECT_TRUE(verdict.is_valid(static_cast<VehicleSignal>(s)))
          << "round " << round << " signal " << s << ": "
          << describe(verdict[static_cast<VehicleSignal>(s)]);
    }
  }
}

/// Whatever the input is, valid values keep the limits, also from one valid value to the next.
TEST_F(PlausibilityTest, WhatIsValidKeepsTheLimits) {
  std::mt19937_64 random(32);
  std::normal_distribution<double> noise(0.0, 6.0);
  const PlausibilityConfig limits;
  for (int round = 0; round < 200; ++round) {
    judge_.reset();
    double last = kNan;
    double since = 0.0;
    double level = 10.0;
    for (int i = 0; i < 200; ++i) {
      if (random() % 40 == 0) level = 90.0 * static_cast<double>(random() % 100) / 100.0;
      const double v = level + (random() % 3 == 0 ? noise(random) : 0.0);
      const auto verdict = judge_.update(drive_.next(v));
      since += kInterval;
      if (!verdict.is_valid(VehicleSignal::kSpeed)) continue;
      ASSERT_LE(std::abs(v), limits.max_speed_m_s);
      if (!std::isnan(last) && !verdict.must_reset) {
        ASSERT_LE(std::abs(v - last), 0.5 + limits.max_accel_m_s2 * since + 1e-9);
      }
      last = v;
      since = 0.0;
    }
  }
}

}  // namespace
}  // namespace plumb
