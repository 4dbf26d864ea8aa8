/// Tests the loop over the table of cues: its order, its gate and its reports.
#include "modules/ground/cue_fuser.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>
#include <string>

namespace plumb {
namespace {

/// A filter with n = (0, 1, 0), ln h = 0 and P = diag(1, 1, 4) 1e-4.
PlaneFilter hand_filter() {
  FilterConfig config;
  config.start_tilt_std_rad = 0.01;
  config.start_ln_height_std = 0.02;
  PlaneFilter filter({}, config);
  filter.start(Eigen::Vector3d::UnitY(), 0.0);
  return filter;
}

/// A point under the camera: an observation of ln h alone.
void observe_height(double ln_height, double var, Observation* out) {
  out->report.status = CueStatus::kUsed;
  out->plane.function = observe_point;
  out->plane.value = {0.0, std::exp(ln_height), 0.0};
  out->plane.cov(0, 0) = var;
  out->plane.first_component = 2;
}

void observe_n3(double n3, double var, Observation* out) {
  out->report.status = CueStatus::kUsed;
  out->plane.function = observe_pitch;
  out->plane.value(0) = n3;
  out->plane.cov(0, 0) = var;
  out->plane.first_component = 1;
}

TEST(CueTable, NamesEveryCueOnce) {
  std::set<std::string> names;
  for (const CueEntry& entry : kCueTable) names.insert(entry.name);
  EXPECT_EQ(names.size(), kNumCues);
  EXPECT_STREQ(kCueTable[kCueDense].name, "dense");
  EXPECT_STREQ(kCueTable[kCuePoints].name, "points");
  EXPECT_STREQ(kCueTable[kCueObjects].name, "objects");
}

TEST(CueFuser, FusesOnlyTheCuesThatAreAskedFor) {
  PlaneFilter filter = hand_filter();
  Observations observations;
  observe_height(0.02, 12e-4, &observations[kCuePoints]);
  observe_n3(0.01, 3e-4, &observations[kCueObjects]);
  fuse_cues(true, &filter, &observations);
  EXPECT_GT(filter.state()(2), 0.0);
  EXPECT_EQ(filter.state()(1), 0.0);
  EXPECT_TRUE(std::isnan(observations[kCueObjects].report.test_ratio));
  fuse_cues(false, &filter, &observations);
  EXPECT_GT(filter.state()(1), 0.0);
}

TEST(CueFuser, ReportsInnovationAndTestRatio) {
  PlaneFilter filter = hand_filter();
  Observations observations;
  // y = 0.04, S = 4e-4 + 12e-4, e^2 = 1, gate 16.
  observe_height(0.04, 12e-4, &observations[kCuePoints]);
  fuse_cues(true, &filter, &observations);
  const CueReport& report = observations[kCuePoints].report;
  EXPECT_EQ(report.status, CueStatus::kUsed);
  EXPECT_NEAR(report.innovation(2), 0.04, 1e-12);
  EXPECT_TRUE(std::isnan(report.innovation(0)));
  EXPECT_NEAR(report.test_ratio, 1.0 / 16.0, 1e-12);
  EXPECT_EQ(observations[kCueDense].report.status, CueStatus::kAbsent);
  EXPECT_TRUE(any_height(observations, CueStatus::kUsed));
  EXPECT_FALSE(any_height(observations, CueStatus::kGated));
}

TEST(CueFuser, MarksWhatTheGateRejects) {
  PlaneFilter filter = hand_filter();
  Observations observations;
  observe_height(0.2, 12e-4, &observations[kCuePoints]);  // e^2 = 25
  observe_n3(0.09, 3e-4, &observations[kCueObjects]);     // e^2 = 20.25
  fuse_cues(true, &filter, &observations);
  fuse_cues(false, &filter, &observations);
  EXPECT_EQ(observations[kCuePoints].report.status, CueStatus::kGated);
  EXPECT_NEAR(observations[kCuePoints].report.test_ratio, 25.0 / 16.0, 1e-12);
  EXPECT_EQ(observations[kCueObjects].report.status, CueStatus::kGated);
  EXPECT_EQ(filter.state(), Eigen::Vector3d::Zero());
  EXPECT_TRUE(any_height(observations, CueStatus::kGated));
  observations[kCuePoints].report.status = CueStatus::kAbsent;
  EXPECT_FALSE(any_height(observations, CueStatus::kGated)) << "objects measure no height";
}

TEST(CueFuser, StartsTheFilterFromTheFirstCueThatIsCertainEnough) {
  Observations observations;
  PlaneFilter filter;
  start_filter(observations, &filter);
  EXPECT_FALSE(filter.started());
  observations[kCuePoints].start_ln_height = 0.3;
  observations[kCuePoints].prior.normal_cam = Eigen::Vector3d(0.0, 1.0, 0.02).normalized();
  start_filter(observations, &filter);
  ASSERT_TRUE(filter.started());
  EXPECT_DOUBLE_EQ(filter.state()(2), 0.3);
  EXPECT_NEAR(filter.state()(1), 0.02, 1e-5);
  observations[kCueDense].start_ln_height = 0.1;
  filter.reset();
  start_filter(observations, &filter);
  EXPECT_DOUBLE_EQ(filter.state()(2), 0.1);
}

TEST(HeightMean, WeighsByInverseVariance) {
  HeightMean mean;
  mean.add({0.1, 1e-4, {0.0, 2.0}});
  mean.add({0.4, 2e-4, {0.0, 5.0}});
  EXPECT_NEAR(mean.mean().ln_height, 0.2, 1e-12);
  EXPECT_NEAR(mean.mean().var, 1e-4 * 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(mean.mean().slope(1), 3.0, 1e-12);
}

}  // namespace
}  // namespace plumb
