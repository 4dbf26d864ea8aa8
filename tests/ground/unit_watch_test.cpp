#include "modules/ground/ego/unit_watch.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

constexpr double kWatchedScale = 2.0;

struct Watch {
  UnitVerdict see(double speed_m_s, double dt_s = 0.1, double std_m_s = 0.05) {
    VoOutput vo;
    vo.status = VoStatus::kOk;
    vo.prev_seq = seq++;
    vo.seq = seq;
    capture_us += static_cast<std::int64_t>(1e6 * dt_s);
    vo.capture_us = capture_us;
    vo.interval_s = dt_s;
    vo.T_prev_cam.t = Eigen::Vector3d(0.0, 0.0, speed_m_s * dt_s / kWatchedScale);
    vo.cov_prev_cam(2, 2) = std_m_s * dt_s / kWatchedScale * std_m_s * dt_s / kWatchedScale;
    vo.scale_carry_std = carry_std;
    vo.reason = reason;
    return watch.watch(vo, kWatchedScale);
  }
  UnitVerdict see_nothing() {
    VoOutput vo;
    vo.status = VoStatus::kCoasting;
    capture_us += 100'000;
    vo.capture_us = capture_us;
    vo.interval_s = 0.1;
    return watch.watch(vo, kWatchedScale);
  }
  UnitWatch watch;
  std::int64_t seq = 0;
  std::int64_t capture_us = 1'000'000;
  double carry_std = 0.0;
  VoReason reason = VoReason::kNone;
};

TEST(UnitWatch, BelievesWhatAVehicleCanDo) {
  Watch rig;
  for (int k = 0; k < 20; ++k) EXPECT_EQ(rig.see(20.0 - 0.9 * k), UnitVerdict::kSteady) << k;
}

TEST(UnitWatch, BelievesAnotherSpeedAfterAGapInWhichItCanHaveChanged) {
  Watch rig;
  for (int k = 0; k < 5; ++k) rig.see(10.0);
  EXPECT_EQ(rig.see(14.0, 2.0), UnitVerdict::kSteady);
}

TEST(UnitWatch, AJumpLosesTheUnitUntilTheSpeedsAreSteady) {
  Watch rig;
  for (int k = 0; k < 5; ++k) rig.see(10.0);
  EXPECT_EQ(rig.see(10.0, 1.0), UnitVerdict::kSteady);
  EXPECT_EQ(rig.see(30.0), UnitVerdict::kJump);
  EXPECT_EQ(rig.see(24.0), UnitVerdict::kUnsettled);
  EXPECT_EQ(rig.see(18.0), UnitVerdict::kUnsettled);
  EXPECT_EQ(rig.see(18.1), UnitVerdict::kUnsettled);
  EXPECT_EQ(rig.see(18.2), UnitVerdict::kUnsettled);
  EXPECT_EQ(rig.see(18.1), UnitVerdict::kSteady);
}

TEST(UnitWatch, SettlesThoughEveryOtherImageMeasuresNothing) {
  Watch rig;
  for (int k = 0; k < 5; ++k) rig.see(10.0);
  EXPECT_EQ(rig.see(30.0), UnitVerdict::kJump);
  UnitVerdict verdict = UnitVerdict::kUnsettled;
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(rig.see_nothing(), UnitVerdict::kUnsettled);
    verdict = rig.see(18.0);
  }
  EXPECT_EQ(verdict, UnitVerdict::kSteady);
}

TEST(UnitWatch, AStepOverAGapOfMissingImagesIsProvenByTheNextOne) {
  Watch rig;
  for (int k = 0; k < 5; ++k) rig.see(10.0);
  rig.reason = VoReason::kFramesMissing;
  EXPECT_EQ(rig.see(9.0, 0.3), UnitVerdict::kSteady) << "a short one";
  EXPECT_EQ(rig.see(6.3, 1.2), UnitVerdict::kUnproven);
  rig.reason = VoReason::kNone;
  EXPECT_EQ(rig.see(6.4), UnitVerdict::kSteady);
  rig.reason = VoReason::kFramesMissing;
  EXPECT_EQ(rig.see(9.0, 1.2), UnitVerdict::kUnproven);
  rig.reason = VoReason::kNone;
  EXPECT_EQ(rig.see(6.4), UnitVerdict::kJump);
}

TEST(UnitWatch, AWideDeviationIsNoJump) {
  Watch rig;
  for (int k = 0; k < 5; ++k) rig.see(10.0);
  EXPECT_EQ(rig.see(16.0, 0.1, 4.0), UnitVerdict::kSteady);
}

TEST(UnitWatch, ANewUnitOfWhichNothingIsKnownMakesNoJump) {
  Watch rig;
  for (int k = 0; k < 5; ++k) rig.see(10.0);
  rig.carry_std = kNan;
  EXPECT_EQ(rig.see(30.0), UnitVerdict::kSteady);
}

}  // namespace
}  // namespace plumb
