#include "tools/evaluate/eval/kitti_metric.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/tools/drives.hpp"

namespace plumb {
namespace {

using test::drive_step;
using test::repeat;

MetricOptions lengths(std::vector<double> lengths_m) {
  MetricOptions options;
  options.lengths_m = std::move(lengths_m);
  return options;
}

TEST(KittiMetric, HasBothLengthSets) {
  EXPECT_EQ(new_kitti_lengths_m(), (std::vector<double>{100, 200, 300, 400, 500, 600, 700, 800}));
  EXPECT_EQ(old_kitti_lengths_m(),
            (std::vector<double>{5, 10, 50, 100, 150, 200, 250, 300, 350, 400}));
}

TEST(KittiMetric, AgreesWithAHandComputationOnAStraightRoad) {
  // WHEN each true step is 1 m and each estimated one 1.1 m, over 31 frames:
  const auto segments =
      segment_errors(repeat(drive_step(1.0), 31), repeat(drive_step(1.1), 31), lengths({10}));
  // THEN a segment ends at the first frame MORE than 10 m ahead, which is the eleventh. From frame
  // 20 on there is none.
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].first_frame, 0);
  EXPECT_EQ(segments[0].last_frame, 11);
  EXPECT_EQ(segments[1].first_frame, 10);
  // Each of the 11 steps is 0.1 m too long, and the segment has 10 m.
  EXPECT_NEAR(segments[0].t_ratio, 0.11, 1e-12);
  EXPECT_NEAR(segments[0].r_rad_m, 0.0, 1e-9);
  // The development kit counts 10 m over twelve frames of 0.1 s.
  EXPECT_NEAR(segments[0].speed_m_s, 10.0 / 1.2, 1e-12);
}

TEST(KittiMetric, AgreesWithAHandComputationOfRotation) {
  // WHEN the estimate turns by 1 mrad per frame and the truth does not:
  const auto segments = segment_errors(repeat(drive_step(1.0), 12),
                                       repeat(drive_step(1.0, 0.001), 12), lengths({10}));
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_NEAR(segments[0].r_rad_m, 11 * 0.001 / 10, 1e-9);
  // For small angles, the end is off sideways by the sum of k mrad over the 11 steps, k = 0..10.
  // The error is stated in the frame of the estimate's end, which is turned by 11 mrad.
  EXPECT_NEAR(segments[0].t_ratio, 0.055 / 10, 1e-5);
}

TEST(KittiMetric, SeesAScaleErrorOnACircleAsTheChord) {
  // WHEN truth and estimate run on circles whose radii differ by 2 %, turning alike:
  const double radius_m = 50.0;
  const double yaw_rad = 0.01;
  const double step_m = 2.0 * radius_m * std::sin(yaw_rad / 2);  // chord of one step
  const auto gt = repeat(drive_step(step_m, yaw_rad), 400);
  const auto est = repeat(drive_step(1.02 * step_m, yaw_rad), 400);
  for (const SegmentError& segment : segment_errors(gt, est, lengths({20, 50, 100}))) {
    const int steps = segment.last_frame - segment.first_frame;
    const double chord_m = 2.0 * radius_m * std::sin(steps * yaw_rad / 2);
    EXPECT_NEAR(segment.t_ratio, 0.02 * chord_m / segment.length_m, 1e-9);
    EXPECT_NEAR(segment.r_rad_m, 0.0, 1e-8);
  }
}

TEST(KittiMetric, DoesNotCareWhichWorldEitherFileUses) {
  const Se3 T_other_world{exp_so3({0.3, -1.0, 0.2}), {94.0, -2.0, 7.0}};
  auto gt = repeat(drive_step(0.9, 0.01), 60);
  auto est = repeat(drive_step(0.92, 0.011), 60);
  const auto before = segment_errors(gt, est, lengths({10, 20}));
  for (PoseMatrix& pose : gt) pose = test::to_matrix(T_other_world) * pose;
  const auto after = segment_errors(gt, est, lengths({10, 20}));
  ASSERT_EQ(before.size(), after.size());
  ASSERT_GT(before.size(), 0U);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(before[i].t_ratio, after[i].t_ratio, 1e-12);
    EXPECT_NEAR(before[i].r_rad_m, after[i].r_rad_m, 1e-9);
  }
}

TEST(KittiMetric, StartsASegmentAtEveryStep) {
  MetricOptions options = lengths({5});
  options.step_frames = 1;
  const auto gt = repeat(drive_step(1.0), 21);
  EXPECT_EQ(segment_errors(gt, gt, options).size(), 15U);  // first frames 0..14, six steps each
}

TEST(KittiMetric, PoolsSegmentsAndSortsThemIntoBins) {
  const std::vector<SegmentError> segments = {
      {0, 9, 10, 5.0, 0.01, 0.001}, {0, 19, 20, 5.0, 0.03, 0.003}, {10, 19, 10, 12.0, 0.05, 0.002}};
  const MetricSummary summary = summarize(segments, {10, 20, 50});
  EXPECT_EQ(summary.all.num_segments, 3);
  EXPECT_NEAR(summary.all.t_percent, 3.0, 1e-12);
  EXPECT_NEAR(summary.all.r_deg_m, 0.002 * 180.0 / std::numbers::pi, 1e-12);
  ASSERT_EQ(summary.by_length.size(), 3U);
  EXPECT_NEAR(summary.by_length[0].error.t_percent, 3.0, 1e-12);
  EXPECT_EQ(summary.by_length[2].error.num_segments, 0);
  EXPECT_TRUE(std::isnan(summary.by_length[2].error.t_percent));
  // 5 m/s lies in the bins at 4 and 6. 12 m/s lies only in the one at 12, because the ends of a bin
  // do not count.
  ASSERT_EQ(summary.by_speed.size(), 3U);
  EXPECT_DOUBLE_EQ(summary.by_speed[0].at, 4.0);
  EXPECT_DOUBLE_EQ(summary.by_speed[1].at, 6.0);
  EXPECT_DOUBLE_EQ(summary.by_speed[2].at, 12.0);
  EXPECT_EQ(summary.by_speed[2].error.num_segments, 1);
}

}  // namespace
}  // namespace plumb
