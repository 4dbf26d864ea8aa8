#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/vo/drive_fixture.hpp"

namespace plumb {
namespace {

using test::drive;
using test::Drive;
using test::RenderedImage;

TEST(Input, ADiscontinuityBeginsAnewWithAUnitOfItsOwn) {
  const std::vector<Se3> poses = drive(16, 0.6);
  Drive d;
  for (const Se3& T : poses) d.see(T);
  ASSERT_EQ(d.last().status, VoStatus::kOk);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const RenderedImage image = d.scene().render(poses[i], 1.0, static_cast<unsigned>(100 + i));
    VoInput input;
    input.seq = 1000 + static_cast<std::int64_t>(i);
    input.image = image.view();
    input.is_discontinuous = i == 0;
    d.show(input);
    const VoOutput& out = d.last();
    EXPECT_TRUE(i >= 2 || out.status == VoStatus::kInitializing) << "nothing is predicted";
    EXPECT_TRUE(out.reason != VoReason::kRestarted || std::isnan(out.scale_carry_std));
  }
  EXPECT_EQ(d.last().status, VoStatus::kOk);
  EXPECT_EQ(d.last().scale_epoch, 1);
}

TEST(Coasting, TheMotionOutOfAPredictedPoseCarriesItsUncertainty) {
  const std::vector<Se3> poses = drive(20, 0.6);
  Drive d;
  for (std::size_t i = 0; i < 16; ++i) d.see(poses[i]);
  const double before = d.last().cov_prev_cam(2, 2);
  const RenderedImage unusable = d.scene().render(poses[16], 1.0, 50);
  d.show(unusable, VoReason::kImageStale);
  const double predicted = d.last().cov_prev_cam(2, 2);
  d.see(poses[17]);
  EXPECT_GE(d.last().cov_prev_cam(2, 2), predicted);
  d.see(poses[18]);
  EXPECT_LT(d.last().cov_prev_cam(2, 2), 3.0 * before);
}

}  // namespace
}  // namespace plumb
