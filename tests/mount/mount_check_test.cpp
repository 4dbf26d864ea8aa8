#include "modules/mount/mount_check.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/numbers.hpp"
#include "tests/ground/straight_drive.hpp"

namespace plumb {
namespace {

using test::kSpeed_m_s;
using test::straight_on;

class MountCheckTest : public testing::Test {
 protected:
  const MountReport& drive(double distance_m, const Eigen::Vector3d& mount_deg,
                           double noise_deg = 0.3) {
    std::normal_distribution<double> noise(0.0, noise_deg * kDegree);
    for (double m = 0.0; m < distance_m; m += 0.1 * kSpeed_m_s) {
      const Eigen::Vector3d shake(noise(random_), noise(random_), noise(random_));
      check_.update(straight_on(mount_deg * kDegree + shake));
    }
    return check_.report();
  }

  std::mt19937 random_{3};
  MountCheck check_{MountConfig{}};
};

const Eigen::Vector3d kMount_deg(-0.6, 0.4, 1.5);

TEST_F(MountCheckTest, SaysHowFarItIsAndThenHoldsAReference) {
  EXPECT_EQ(check_.report().progress, 0.0);
  const MountReport& report = drive(250.0, kMount_deg);
  EXPECT_EQ(report.status, MountStatus::kCollecting);
  EXPECT_NEAR(report.progress, 0.5, 0.03);
  EXPECT_FALSE(report.reference.has_value());
  drive(260.0, kMount_deg);
  EXPECT_EQ(report.status, MountStatus::kSteady);
  EXPECT_EQ(report.progress, 1.0);
  ASSERT_TRUE(report.reference.has_value());
  EXPECT_LT((report.reference->mean_rad - kMount_deg * kDegree).norm(), 0.1 * kDegree);
  EXPECT_GT(report.reference->std_rad.minCoeff(), 0.0);
}

TEST_F(MountCheckTest, SaysWhyAnImageToldNothing) {
  GroundOutput output = straight_on(Eigen::Vector3d::Zero());
  output.ego.rate_ground_rad_s.z() = -0.3;
  EXPECT_EQ(check_.update(output).reason, MountReason::kTurning);
  output.ego.velocity_ground_m_s.x() = 1.0;
  EXPECT_EQ(check_.update(output).reason, MountReason::kSlow);
  output.plane.status = GroundStatus::kHeld;
  EXPECT_EQ(check_.update(output).reason, MountReason::kNoPlane);
  output.ego.status = EgoStatus::kScaleHeld;
  EXPECT_EQ(check_.update(output).reason, MountReason::kNoMotion);
  EXPECT_EQ(check_.report().progress, 0.0);
  EXPECT_EQ(check_.update(straight_on(Eigen::Vector3d::Zero())).reason, MountReason::kNone);
}

TEST_F(MountCheckTest, ALooseCameraMakesNoReferenceUntilItIsFixed) {
  for (int i = 0; i < 12; ++i) drive(50.0, {i % 2 == 0 ? 1.5 : -1.5, 0.0, 0.0});
  EXPECT_EQ(check_.report().status, MountStatus::kUnsteady);
  EXPECT_FALSE(check_.report().reference.has_value());
  EXPECT_GT(check_.report().spread_rad.x(), 1.2 * kDegree);
  drive(560.0, {0.5, 0.0, 0.0});
  EXPECT_EQ(check_.report().status, MountStatus::kSteady);
}

TEST_F(MountCheckTest, AKnockedCameraIsSaidAndTheAlarmHasHysteresis) {
  drive(520.0, kMount_deg);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3d off_deg = Eigen::Vector3d::Zero();
    off_deg(axis) = 2.0;
    EXPECT_EQ(drive(250.0, kMount_deg + off_deg).status, MountStatus::kMoved) << axis;
    // Between the two limits the status stays as it is.
    off_deg(axis) = 0.75;
    EXPECT_EQ(drive(250.0, kMount_deg + off_deg).status, MountStatus::kMoved) << axis;
    EXPECT_EQ(drive(250.0, kMount_deg).status, MountStatus::kSteady) << axis;
    EXPECT_EQ(drive(250.0, kMount_deg + off_deg).status, MountStatus::kSteady) << axis;
  }
}

TEST_F(MountCheckTest, LoadInTheBootAndHillsAreNoAlarm) {
  drive(520.0, kMount_deg);
  EXPECT_EQ(drive(300.0, kMount_deg + Eigen::Vector3d(0.7, 0.0, 0.0)).status, MountStatus::kSteady);
}

TEST_F(MountCheckTest, GoesOnFromAnEarlierReference) {
  check_.restore({kMount_deg * kDegree, Eigen::Vector3d::Constant(0.001), 10});
  EXPECT_EQ(check_.report().status, MountStatus::kSteady);
  EXPECT_EQ(drive(150.0, kMount_deg + Eigen::Vector3d(0.0, 0.0, 2.0)).status, MountStatus::kSteady);
  EXPECT_EQ(drive(110.0, kMount_deg + Eigen::Vector3d(0.0, 0.0, 2.0)).status, MountStatus::kMoved);
}

TEST_F(MountCheckTest, ACameraThatLooksFarAsideIsSaidBesideItsReference) {
  for (const Eigen::Vector3d& off_deg :
       {Eigen::Vector3d(11.0, 0.0, 0.0), Eigen::Vector3d(0.0, 0.0, -11.0)}) {
    check_ = MountCheck{MountConfig{}};
    EXPECT_EQ(drive(110.0, off_deg).status, MountStatus::kCollecting) << "two stretches are few";
    EXPECT_EQ(drive(100.0, off_deg).status, MountStatus::kMisaligned);
    EXPECT_EQ(drive(310.0, off_deg).status, MountStatus::kMisaligned);
    EXPECT_TRUE(check_.report().reference.has_value());
    EXPECT_EQ(drive(250.0, Eigen::Vector3d::Zero()).status, MountStatus::kMoved)
        << "it differs from its reference";
  }
  check_ = MountCheck{MountConfig{}};
  EXPECT_EQ(drive(520.0, {9.0, 0.0, -9.0}).status, MountStatus::kSteady);
}

TEST_F(MountCheckTest, AnUpsideDownPictureTellsNothing) {
  GroundOutput output = straight_on(Eigen::Vector3d::Zero());
  output.ego.status = EgoStatus::kLost;
  output.ego.reason = VoReason::kImageUpsideDown;
  EXPECT_EQ(check_.update(output).reason, MountReason::kUpsideDown);
}

}  // namespace
}  // namespace plumb
