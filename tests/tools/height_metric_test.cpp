#include "tools/evaluate/eval/height_metric.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/input_error.hpp"
#include "tests/support/expect_throw.hpp"

namespace plumb {
namespace {

/// Frames of 1 m each, in which VO's unit is 2 m and the filter's height is 2 % above 1.65 m.
struct Straight {
  std::vector<PoseMatrix> poses;
  std::vector<HeightRow> rows;

  explicit Straight(int num_frames) {
    for (int k = 0; k < num_frames; ++k) {
      PoseMatrix T = PoseMatrix::Identity();
      T(2, 3) = k;
      poses.push_back(T);
      HeightRow row;
      row.seq = k;
      row.vo_ok = k > 0;
      row.step_vo = k > 0 ? 0.5 : 0.0;
      if (k > 0) row.log_scale = std::log(2.0 / 1.02);
      if (k > 0) row.dense_vo = 0.84;
      rows.push_back(row);
    }
  }
};

TEST(HeightMetric, TurnsHeightsIntoMetresByTheTrueStep) {
  const Straight drive(10);
  const HeightErrors errors = height_by_true_step(drive.poses, drive.rows, {}, 1.65);
  const HeightSummary fused = summarize_heights(errors.at("fused"));
  EXPECT_EQ(fused.num_frames, 9);
  EXPECT_NEAR(fused.mean_percent, 2.0, 1e-9);
  EXPECT_NEAR(fused.bias_percent, 2.0, 1e-9);
  EXPECT_NEAR(summarize_heights(errors.at("dense")).bias_percent, 100.0 * (1.68 / 1.65 - 1.0),
              1e-9);
  EXPECT_TRUE(errors.at("points").empty());
  EXPECT_NEAR(summarize_heights(errors.at("constant")).mean_percent, 0.0, 1e-12);
}

TEST(HeightMetric, ComparesWithMeasuredPlanesWhereThereAreSome) {
  const Straight drive(10);
  std::map<std::int64_t, TruePlane> truth;
  truth[3].height_m = 1.5;
  const HeightErrors errors = height_by_true_step(drive.poses, drive.rows, truth, 1.65);
  EXPECT_NEAR(errors.at("constant")[2].error_percent, 10.0, 1e-9);
  EXPECT_NEAR(errors.at("constant")[3].error_percent, 0.0, 1e-9);
  EXPECT_NEAR(errors.at("dense")[2].error_percent, 12.0, 1e-9);
}

TEST(HeightMetric, DoesNotMixScaleEpochs) {
  Straight drive(10);
  // WHEN the unit changes at frame 5, a step from before must not stand beside heights of after.
  for (std::size_t k = 5; k < 10; ++k) {
    drive.rows[k].scale_epoch = 1;
    drive.rows[k].step_vo = 0.25;
    drive.rows[k].dense_vo = 0.42;
  }
  const HeightErrors errors = height_by_true_step(drive.poses, drive.rows, {}, 1.65);
  for (const HeightError& error : errors.at("dense")) {
    EXPECT_NEAR(error.error_percent, 100.0 * (1.68 / 1.65 - 1.0), 1e-9) << error.seq;
  }
}

TEST(HeightMetric, RefusesTruthOfAnotherDrive) {
  Straight drive(10);
  drive.poses.pop_back();
  test::expect_contains(
      test::input_error_of([&] { (void)height_by_true_step(drive.poses, drive.rows, {}, 1.65); }),
      "10 rows, the truth 9 poses");
}

}  // namespace
}  // namespace plumb
