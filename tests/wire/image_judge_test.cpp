#include "modules/vo/image_judge_wire.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "modules/vo/vo_wire.hpp"
#include "tests/support/scene.hpp"

namespace plumb {
namespace {

constexpr std::int64_t kPeriodUs = 100'000;

class ImageJudgeTest : public ::testing::Test {
 protected:
  /// Judges the picture number `pose` of a drive. Returns why it is refused, "" when it is not.
  std::string show(std::int64_t seq, std::int64_t stamp_us, std::size_t pose,
                   std::int64_t session = 0) {
    ImageFrame frame;
    frame.seq = seq;
    frame.capture_us = stamp_us;
    frame.session = session;
    arrival_us_ += kPeriodUs;
    if (const char* why = judge_.judge_time(frame, arrival_us_)) return why;
    const test::RenderedImage image =
        scene_.render(poses_[pose], 1.0, static_cast<unsigned>(++num_rendered_));
    input_ = judge_.judge_picture(image.view());
    to_wire(VoOutput{}, &motion_);
    judge_.complete(&motion_);
    return "";
  }
  /// A sound image.
  std::string show(std::int64_t seq) {
    return show(seq, 1'000'000 + seq * kPeriodUs, static_cast<std::size_t>(seq));
  }

  std::vector<Se3> poses_ = test::drive(40, 0.6);
  test::Scene scene_{test::scene_camera()};
  ImageJudge judge_{IntegrityConfig{}, 620, 188};
  std::int64_t arrival_us_ = 5'000'000;
  int num_rendered_ = 0;
  VoInput input_;
  vo_motion_t motion_{};
};

TEST_F(ImageJudgeTest, VouchesForTheIntervalFromTheThirdImageOn) {
  for (std::int64_t seq = 0; seq < 8; ++seq) {
    ASSERT_EQ(show(seq), "");
    EXPECT_EQ(motion_.prev_seq, seq - 1);
    EXPECT_EQ(std::isnan(motion_.interval_s), seq < 2) << seq;
    EXPECT_EQ(input_.unusable, VoReason::kNone) << seq;
    EXPECT_NEAR(input_.interval_s, 0.1, 1e-9);
  }
  EXPECT_NEAR(motion_.interval_s, 0.1, 1e-9);
}

TEST_F(ImageJudgeTest, MapsStampsToTheClockOfArrival) {
  for (std::int64_t seq = 0; seq < 12; ++seq) ASSERT_EQ(show(seq), "");
  EXPECT_EQ(motion_.capture_mono_us, arrival_us_);
}

TEST_F(ImageJudgeTest, OneStampAnHourAheadCostsTwoIntervals) {
  for (std::int64_t seq = 0; seq < 10; ++seq) ASSERT_EQ(show(seq), "");
  ASSERT_EQ(show(10, 3'600'000'000, 10), "");
  EXPECT_TRUE(std::isnan(motion_.interval_s));
  EXPECT_EQ(motion_.reason, vo_motion_t::REASON_TIME_FORWARD);
  EXPECT_EQ(motion_.capture_mono_us, 0) << "its age is not known";
  EXPECT_NEAR(input_.interval_s, 0.1, 1e-3) << "the best guess";
  ASSERT_EQ(show(11), "");
  EXPECT_TRUE(std::isnan(motion_.interval_s)) << "the motion begins at the image in doubt";
  ASSERT_EQ(show(12), "");
  EXPECT_NEAR(motion_.interval_s, 0.1, 1e-9);
}

TEST_F(ImageJudgeTest, APublisherWithDistantNumbersIsRefused) {
  for (std::int64_t seq = 0; seq < 20; ++seq) {
    ASSERT_EQ(show(seq), "") << seq;
    if (seq >= 8) {
      EXPECT_NE(show(5000 + seq, 1'050'000 + seq * kPeriodUs, 30), "") << seq;
    }
    EXPECT_FALSE(input_.is_discontinuous) << seq;
  }
}

TEST_F(ImageJudgeTest, ARestartedSourceBeginsAnewWithNumbersOfItsOwn) {
  for (std::int64_t seq = 20; seq < 30; ++seq) ASSERT_EQ(show(seq), "");
  const std::int64_t before = input_.seq;
  EXPECT_NE(show(0, 500'000, 30, 1), "");
  EXPECT_NE(show(1, 600'000, 31, 1), "");
  ASSERT_EQ(show(2, 700'000, 32, 1), "");
  EXPECT_TRUE(input_.is_discontinuous);
  EXPECT_GT(input_.seq, before) << "the estimator's numbers never go back";
  EXPECT_EQ(motion_.seq, 2);
  EXPECT_EQ(motion_.prev_seq, -1);
}

TEST_F(ImageJudgeTest, ARepeatedPictureIsUnusable) {
  for (std::int64_t seq = 0; seq < 20; ++seq) ASSERT_EQ(show(seq), "");
  ASSERT_EQ(show(20, 1'000'000 + 20 * kPeriodUs, 19), "");
  EXPECT_EQ(input_.unusable, VoReason::kImageRepeated);
  ASSERT_EQ(show(21), "");
  EXPECT_EQ(input_.unusable, VoReason::kNone);
}

TEST_F(ImageJudgeTest, ADoubtedIntervalLeavesNoCarryOfTheScale) {
  for (std::int64_t seq = 0; seq < 10; ++seq) ASSERT_EQ(show(seq), "");
  ASSERT_EQ(show(10, 3'600'000'000, 10), "");
  motion_.scale_carry_std = 0.1;
  judge_.complete(&motion_);
  EXPECT_TRUE(std::isnan(motion_.scale_carry_std));
}

}  // namespace
}  // namespace plumb
