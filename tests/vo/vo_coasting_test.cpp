/// Tests what the odometry makes of images that show nothing, on rendered drives with exact truth.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/vo/drive_fixture.hpp"

namespace plumb {
namespace {

using test::Drive;
using test::drive;
using test::mean_step;
using test::RenderedImage;

TEST(Coasting, OverABlackoutItPredictsAndFindsItsLandmarksAgain) {
  const std::vector<Se3> poses = drive(34, 0.6);
  Drive d;
  const RenderedImage black{std::vector<std::uint8_t>(620 * 188, 1), 620, 188};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i >= 18 && i < 24) {
      d.show(black);
      EXPECT_EQ(d.last().status, VoStatus::kCoasting);
      EXPECT_EQ(d.last().reason, VoReason::kImageDark);
      EXPECT_GT(d.last().T_prev_cam.t.z(), 0.0);
      EXPECT_GT(d.last().cov_prev_cam(2, 2), d.results()[17].cov(2, 2));
    } else {
      d.see(poses[i]);
    }
    if (i >= 24) {
      EXPECT_EQ(d.last().status, VoStatus::kOk) << i;
      EXPECT_EQ(d.last().scale_epoch, 0) << i;
    }
  }
  const double before = mean_step(d, 10, 18);
  EXPECT_NEAR(mean_step(d, 26, 34) / before, 1.0, 0.04);
  // The first good frame corrects the error of the prediction.
  double whole = 0.0;
  for (std::size_t i = 18; i <= 24; ++i) whole += d.results()[i].T_prev_cam.t.z();
  EXPECT_NEAR(whole / (7.0 * before), 1.0, 0.04);
}

TEST(Coasting, EndsAsLostAfterItsLimit) {
  Drive d;
  for (const Se3& T : drive(12, 0.6)) d.see(T);
  const RenderedImage flat{std::vector<std::uint8_t>(620 * 188, 200), 620, 188};
  for (int i = 0; i < 30; ++i) {
    d.show(flat);
    const double unseen_s = 0.1 * (i + 1);
    if (std::abs(unseen_s - Drive::config().coast_limit_s) < 0.01) continue;
    const bool within = unseen_s < Drive::config().coast_limit_s;
    EXPECT_EQ(d.last().status, within ? VoStatus::kCoasting : VoStatus::kLost) << i;
    EXPECT_EQ(d.last().reason, VoReason::kImageFlat);
  }
}

TEST(Coasting, AnUnusableImageIsNotAStandstill) {
  const std::vector<Se3> poses = drive(14, 0.6);
  Drive d;
  for (const Se3& T : poses) d.see(T);
  const RenderedImage frozen = d.scene().render(poses.back(), 1.0, 7);
  d.show(frozen);
  for (int i = 0; i < 4; ++i) {
    d.show(frozen, VoReason::kImageFrozen);
    EXPECT_EQ(d.last().status, VoStatus::kCoasting);
    EXPECT_EQ(d.last().reason, VoReason::kImageFrozen);
  }
}

// The second image of all is not known to be a repeated one yet.
TEST(Coasting, PicturesThatComeSeveralTimesGiveTheTrueSpeedFromTheStart) {
  for (const int num_times : {2, 3}) {
    Drive d;
    const std::vector<Se3> poses = drive(14, 0.6);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      d.see(poses[i]);
      for (int k = 1; k < num_times; ++k) {
        const RenderedImage again = d.scene().render(
            poses[i], 1.0, 500U + 10U * static_cast<unsigned>(i) + static_cast<unsigned>(k));
        d.show(again, i == 0 ? VoReason::kNone : VoReason::kImageRepeated);
      }
    }
    const std::size_t num = d.results().size();
    const double usual = mean_step(d, num - 8, num);
    for (std::size_t i = 1; i < num; ++i) {
      if (d.results()[i].status != VoStatus::kOk) continue;
      EXPECT_NEAR(d.results()[i].T_prev_cam.t.norm(), usual, 0.2 * usual) << num_times << ' ' << i;
    }
  }
}

TEST(Coasting, ATornPictureBeginsANewMapAndCarriesTheUnit) {
  const std::vector<Se3> poses = drive(24, 0.6);
  Drive d;
  for (std::size_t i = 0; i < 12; ++i) d.see(poses[i]);
  d.show(d.scene().render(poses[12], 1.0, 7), VoReason::kImageTorn);
  EXPECT_EQ(d.last().status, VoStatus::kCoasting);
  for (std::size_t i = 13; i < 24; ++i) d.see(poses[i]);
  EXPECT_EQ(d.last().status, VoStatus::kOk);
  EXPECT_EQ(d.last().scale_epoch, 1);
  EXPECT_NEAR(mean_step(d, 18, 24), mean_step(d, 6, 12), 0.1 * mean_step(d, 6, 12));
}

// What was predicted before a long gap leads the search astray, image after image.
TEST(Restart, FindsItsWayAfterAGapThoughTheCarTurnsTheOtherWayNow) {
  Drive d;
  const auto turning = [](double yaw_rad, double z) {
    return Se3{exp_so3({0.0, yaw_rad, 0.0}), {0.0, 0.0, z}};
  };
  for (int i = 0; i < 12; ++i) d.see(turning(0.05 * i, 0.6 * i));
  ASSERT_EQ(d.last().status, VoStatus::kOk);
  d.skip(100);
  for (int i = 0; i < 6; ++i) d.see(turning(-0.05 * i, 20.0 + 0.6 * i));
  EXPECT_EQ(d.last().status, VoStatus::kOk);
}

}  // namespace
}  // namespace plumb
