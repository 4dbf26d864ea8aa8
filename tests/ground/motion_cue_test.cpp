#include "modules/ground/cues/motion_cue.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb {
namespace {

class MotionCueTest : public ::testing::Test {
 protected:
  MotionCueTest() {
    frame_.vo = &vo_;
    frame_.chord.valid = true;
    frame_.chord.length = 3.0;
    vo_.road_height = 0.5;
    vo_.road_height_std = 0.02;
  }

  FilterConfig config_;
  MotionCue cue_{config_};
  VoOutput vo_;
  CueFrame frame_;
  FramePrior prior_;
};

TEST_F(MotionCueTest, ObservesTheLogarithmOfTheHeight) {
  const Observation seen = cue_.measure(frame_, prior_);
  EXPECT_EQ(seen.report.status, CueStatus::kUsed);
  EXPECT_EQ(seen.report.height, 0.5);
  EXPECT_NEAR(seen.report.height_var, 4e-4, 1e-12);
  const Eigen::Vector3d plane(0.01, 0.02, std::log(0.4));
  const Linearisation at = seen.plane.function(seen.plane.value, plane);
  EXPECT_EQ(at.num_rows, 1);
  EXPECT_NEAR(at.innovation(0), std::log(0.5 / 0.4), 1e-12);
  EXPECT_TRUE(at.jacobian.row(0) == Eigen::RowVector3d(0.0, 0.0, 1.0));
  // Images share the error of the pitch, which is most of the deviation.
  EXPECT_LT(seen.plane.cov(0, 0), 0.1 * seen.plane.speed_error_var);
  EXPECT_NEAR(seen.plane.cov(0, 0) + seen.plane.speed_error_var, 4e-4 / square(0.5), 1e-12);
}

TEST_F(MotionCueTest, StartsTheFilterAndMakesTheFrameMeasurable) {
  const Observation seen = cue_.measure(frame_, prior_);
  EXPECT_NEAR(seen.start_ln_height, std::log(0.5), 1e-12);
  EXPECT_TRUE(seen.prior.measurable);
  EXPECT_NEAR(cue_.height_over(Eigen::Vector3d::Zero()).ln_height, std::log(0.5), 1e-12);
}

TEST_F(MotionCueTest, ObservesNothingWithoutAHeight) {
  vo_.road_height = kNan;
  EXPECT_EQ(cue_.measure(frame_, prior_).report.status, CueStatus::kAbsent);
}

TEST_F(MotionCueTest, ObservesNothingWhenVosStepMeansNothing) {
  frame_.chord.valid = false;
  EXPECT_EQ(cue_.measure(frame_, prior_).report.status, CueStatus::kAbsent);
}

}  // namespace
}  // namespace plumb
