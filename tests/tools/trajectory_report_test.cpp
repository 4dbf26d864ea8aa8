#include "tools/evaluate/eval/trajectory_report.hpp"

#include <gtest/gtest.h>

#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/tools/drives.hpp"

namespace plumb {
namespace {

using test::drive_step;
using test::expect_contains;
using test::input_error_of;
using test::repeat;
using test::to_file;

EvalOptions short_lengths() {
  EvalOptions options;
  options.metric.lengths_m = {10};
  return options;
}

TEST(TrajectoryReport, PoolsSegmentsNotSequences) {
  const test::TempFolder folder;
  // WHEN a short drive is 10 % off and a long one right:
  folder.write("gt/a.txt", to_file(repeat(drive_step(1.0), 12)));
  folder.write("est/a.txt", to_file(repeat(drive_step(1.1), 12)));
  folder.write("gt/b.txt", to_file(repeat(drive_step(1.0), 42)));
  folder.write("est/b.txt", to_file(repeat(drive_step(1.0), 42)));
  folder.write("gt/c.txt", to_file(repeat(drive_step(1.0), 42)));  // nobody estimated it
  const EvalOptions options = short_lengths();
  const TrajectoryReport report =
      pool(evaluate_folders(folder / "gt", folder / "est", options), options);
  ASSERT_EQ(report.sequences.size(), 2U);
  EXPECT_EQ(report.sequences[0].name, "a");
  EXPECT_EQ(report.pooled.all.num_segments, 5);
  EXPECT_NEAR(report.pooled.all.t_percent, 11.0 / 5.0, 1e-5);
  EXPECT_NEAR(report.mean_of_sequences.t_percent, 5.5, 1e-5);
}

TEST(TrajectoryReport, RefusesADifferentNumberOfRowsUnlessAllowed) {
  const test::TempFolder folder;
  const auto gt = folder.write("gt.txt", to_file(repeat(drive_step(1.0), 30)));
  const auto est = folder.write("est.txt", to_file(repeat(drive_step(1.0), 28)));
  EvalOptions options = short_lengths();
  expect_contains(input_error_of([&] { (void)evaluate_sequence("x", gt, est, options); }),
                  "has 30 rows");
  options.allow_partial = true;
  EXPECT_EQ(evaluate_sequence("x", gt, est, options).gt.size(), 28U);
}

TEST(TrajectoryReport, RefusesEmptyFilesAndFolders) {
  const test::TempFolder folder;
  const auto gt = folder.write("gt/a.txt", to_file(repeat(drive_step(1.0), 30)));
  const auto est = folder.write("est/b.txt", "");
  const EvalOptions options = short_lengths();
  expect_contains(input_error_of([&] { (void)evaluate_sequence("x", gt, est, options); }),
                  "holds no pose");
  expect_contains(
      input_error_of([&] { (void)evaluate_folders(folder / "gt", folder / "est", options); }),
      "is in both");
  expect_contains(
      input_error_of([&] { (void)evaluate_folders(folder / "none", folder / "est", options); }),
      "none is not a folder");
}

}  // namespace
}  // namespace plumb
