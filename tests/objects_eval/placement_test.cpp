/// Places of known error against labels: figures, selection, matching, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/objects_eval/placed_drive.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/run_program.hpp"
#include "tools/evaluate/objects_eval/placement_report.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;
using test::PlacedDrive;

DrivePlacement evaluate(PlacedDrive* drive, const PlacementOptions& options = {}) {
  const std::filesystem::path folder = drive->write();
  return evaluate_placement(folder, drive->file("frames.csv"), drive->file("objects.csv"), options);
}

/// Depth error of a car at x that is off by d, in percent of its true depth.
double percent(double x_m, double off_m) {
  const RoadPlane road = test::placed_road();
  const double truth_m = road.cam_from_ground({x_m, 0.0, 0.0}).z();
  return 100.0 * (road.cam_from_ground({x_m + off_m, 0.0, 0.0}).z() - truth_m) / truth_m;
}

/// A parked car that comes nearer from 40 m and one ahead that drives as fast as we do, at 8 m.
void add_two_cars(PlacedDrive* drive) {
  for (int frame = 0; frame < test::kPlacedFrames; ++frame) {
    drive->add(frame, 1, 40.0 - frame, 0.1 * (40.0 - frame), "2,1,0");
    drive->add(frame, 2, 8.0, frame % 3 == 0 ? -0.8 : 0.4, "0.4,1,0");
  }
}

TEST(Placement, FindsTheErrorsThatWereMade) {
  PlacedDrive drive;
  add_two_cars(&drive);
  const DrivePlacement result = evaluate(&drive);
  EXPECT_EQ(result.name, "drive");
  EXPECT_EQ(result.num_labels, 24u);
  EXPECT_EQ(result.samples.size(), 24u);

  const auto close = placement_figures(result.samples, Range::kClose, Motion::kAny);
  EXPECT_EQ(close.num_samples, 12u);
  const double low = percent(8.0, -0.8), high = percent(8.0, 0.4);
  EXPECT_NEAR(close.depth_mean_percent, (2.0 * high - low) / 3.0, 1e-6);
  EXPECT_NEAR(close.depth_median_percent, high, 1e-6);
  EXPECT_NEAR(close.depth_bias_percent, (2.0 * high + low) / 3.0, 1e-6);
  EXPECT_NEAR(close.depth_nees, (2.0 * 1.0 + 4.0) / 3.0, 1e-6)
      << "one and two standard deviations off";
  EXPECT_NEAR(close.position_nees, 0.5 * close.depth_nees, 1e-6) << "no error to the side";

  const auto distant = placement_figures(result.samples, Range::kDistant, Motion::kAny);
  EXPECT_NEAR(distant.depth_mean_percent, 10.0, 0.02);
  EXPECT_NEAR(distant.position_mean_percent, 10.0, 0.02) << "the error lies along the road";
  EXPECT_GT(distant.position_mean_percent, distant.depth_mean_percent) << "which leans away";
}

TEST(Placement, NeedsNoImages) {
  PlacedDrive with_images, without(false);
  add_two_cars(&with_images);
  add_two_cars(&without);
  const DrivePlacement expected = evaluate(&with_images);
  const DrivePlacement result = evaluate(&without);
  ASSERT_EQ(result.samples.size(), 24u);
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    EXPECT_EQ(result.samples[i].speed_m_s, expected.samples[i].speed_m_s);
  }
}

TEST(Placement, TellsWhatStandsFromWhatMoves) {
  PlacedDrive drive;
  add_two_cars(&drive);
  const DrivePlacement result = evaluate(&drive);
  for (const PlacementSample& sample : result.samples)
    EXPECT_NEAR(sample.speed_m_s, sample.track_id == 1 ? 0.0 : 10.0, 1e-4);
  const auto num = [&](Range range, Motion motion) {
    return placement_figures(result.samples, range, motion).num_samples;
  };
  EXPECT_EQ(num(Range::kDistant, Motion::kStanding), 12u);
  EXPECT_EQ(num(Range::kDistant, Motion::kMoving), 0u);
  EXPECT_EQ(num(Range::kClose, Motion::kMoving), 12u);
  EXPECT_TRUE(std::isnan(
      placement_figures(result.samples, Range::kClose, Motion::kStanding).depth_mean_percent));

  // WHEN there are no poses, nothing is known to stand or to move.
  std::filesystem::remove(drive.write() / "poses.txt");
  const DrivePlacement without = evaluate(&drive);
  EXPECT_EQ(without.samples.size(), 24u);
  for (const Motion motion : {Motion::kStanding, Motion::kMoving})
    EXPECT_EQ(placement_figures(without.samples, Range::kDistant, motion).num_samples, 0u);
}

TEST(Placement, PutsFootPointsOntoTheReportedAndTheCalibratedPlane) {
  PlacedDrive drive;
  add_two_cars(&drive);
  const auto figures = placement_figures(evaluate(&drive).samples, Range::kDistant, Motion::kAny);
  EXPECT_LT(figures.foot_percent, 1e-3) << "boxes and plane are exact";
  // A row at which the pitched road is d away shows a level one at 1 / (1/d - 0.01/1.65).
  double expected_percent = 0.0;
  for (int frame = 0; frame < test::kPlacedFrames; ++frame) {
    const double truth_m = 40.0 - frame, rear_m = truth_m - 0.5 * 1.67 * 2.4;
    const double seen_m = 1.0 / (1.0 / rear_m - 0.01 / 1.65);
    expected_percent += 100.0 * (seen_m - rear_m) / truth_m / test::kPlacedFrames;
  }
  EXPECT_NEAR(figures.foot_calibrated_percent, expected_percent, 0.05);
  PlacementOptions options;
  options.objects.plane = "calibrated";
  const auto on_calibrated =
      placement_figures(evaluate(&drive, options).samples, Range::kDistant, Motion::kAny);
  EXPECT_EQ(on_calibrated.foot_percent, figures.foot_calibrated_percent);
}

TEST(Placement, UsesTheCovarianceBetweenTheAxes) {
  PlacedDrive drive;
  drive.add(0, 1, 20.0, 2.0, "2,1,1.8");
  const DrivePlacement result = evaluate(&drive);
  ASSERT_EQ(result.samples.size(), 1u);
  EXPECT_NEAR(result.samples[0].depth_nees, 1.0, 1e-6);
  EXPECT_NEAR(result.samples[0].position_nees, 0.5 / (1.0 - 0.81), 1e-5);
}

TEST(Placement, TakesWholeVehiclesOfTheAskedClasses) {
  PlacedDrive drive;
  drive.add(0, 1, 20.0, 0.0, "2,1,0");
  drive.add(0, 2, 20.0, 0.0, "2,1,0", "Van 0 1");
  drive.add(0, 3, 20.0, 0.0, "2,1,0", "Car 0 2");                              // largely hidden
  drive.add(0, 4, 20.0, 0.0, "2,1,0", "Car 1 0");                              // cut
  drive.add(0, 5, 20.0, 0.0, "2,1,0", "Truck 0 0");                            // not asked for
  drive.add(0, 6, 20.0, 0.0, "2,1,0", "Cyclist 0 0");                          // no vehicle
  drive.add_label("1 1 Car 0 0 0 590 150 610 200 1.5 1.67 4 0 1.6 20 -1.57");  // not placed
  drive.add_row("1,1,,,,,");
  DrivePlacement result = evaluate(&drive);
  EXPECT_EQ(result.num_labels, 3u);
  EXPECT_EQ(result.samples.size(), 2u);
  PlacementOptions options;
  options.classes = {ObjectClass::kTruck};
  result = evaluate(&drive, options);
  ASSERT_EQ(result.samples.size(), 1u);
  EXPECT_EQ(result.samples[0].track_id, 5);
}

TEST(Placement, MatchesATrackersBoxesByOverlap) {
  PlacedDrive drive;
  drive.add_label("0 1 Car 0 0 0 500 150 600 200 1.5 1.67 4 0 1.6 20 -1.57");
  drive.add_label("0 2 Car 0 0 0 700 150 800 200 1.5 1.67 4 0 1.6 30 -1.57");
  drive.add_row("0,71,22,0,1,1,0");
  drive.add_row("0,72,50,0,1,1,0");
  drive.write_boxes(
      "0 72 Car -1 -1 -10 520 150 620 200 -1 -1 -1 -1 -1 -1 -1 1\n"
      "0 71 Car -1 -1 -10 503 151 602 201 -1 -1 -1 -1 -1 -1 -1 1\n"
      "0 73 Car -1 -1 -10 770 150 870 200 -1 -1 -1 -1 -1 -1 -1 1\n");
  PlacementOptions options;
  options.boxes = "det2d/T.txt";
  const DrivePlacement result = evaluate(&drive, options);
  EXPECT_EQ(result.num_labels, 2u);
  ASSERT_EQ(result.samples.size(), 1u) << "label 2 shares less than half of its box with any";
  EXPECT_EQ(result.samples[0].track_id, 1);
  EXPECT_NEAR(result.samples[0].depth_m, 22.0, 0.02) << "track 71 overlaps more than 72";
}

TEST(Placement, NamesFileAndLineOfWrongTables) {
  const auto why = [](const std::string& row, const std::string& label = "") {
    PlacedDrive drive;
    drive.add(0, 1, 20.0, 2.0, "2,1,0");
    drive.add_row(row);
    if (!label.empty()) drive.add_label(label);
    return input_error_of([&] { (void)evaluate(&drive); });
  };
  expect_contains(why("1,1,20"), "objects.csv:3: 3 cells");
  expect_contains(why("1,1,x,0,1,1,0"), "objects.csv:3: x_m: 'x' is not a number");
  expect_contains(why("1,1,20,0,,1,0"), "objects.csv:3: x_std_m is empty");
  expect_contains(why("1,1,20,0,0,1,0"), "objects.csv:3: x_std_m = 0");
  expect_contains(why("1,1,20,0,1,1,1"), "objects.csv:3: x_std_m = 1, y_std_m = 1, xy_cov_m2 = 1");
  expect_contains(why(",1,20,0,1,1,0"), "objects.csv:3: seq is empty");
  expect_contains(why("1.5,1,20,0,1,1,0"), "objects.csv:3: seq = 1.5 is not a whole number");
  expect_contains(why("0,1,20,0,1,1,0"), "objects.csv:3: track 1 has two rows in image 0");
  expect_contains(why("1,1,inf,0,1,1,0"), "objects.csv:3: x_m");
  expect_contains(why("1,1,20,0,1,1,0", "3 4 Car"), "label_02.txt:2: 3 columns");
  PlacedDrive drive;
  (void)drive.write();
  expect_contains(input_error_of([&] {
                    (void)evaluate_placement(drive.file("drive"), drive.file("frames.csv"),
                                             drive.file("frames.csv"), {});
                  }),
                  "frames.csv:1: column track_id is missing");
}

TEST(Placement, AsAProgramPrintsATableAndWritesTheSameAsJson) {
  PlacedDrive drive;
  add_two_cars(&drive);
  const std::string files = drive.write().string() + " " + drive.file("frames.csv").string() + " " +
                            drive.file("objects.csv").string();
  const test::TempFolder folder;
  const std::string json_file = (folder / "p.json").string();
  const auto result = test::run_program(folder, "plumb-eval",
                                        "placed " + files + " " + files + " --json " + json_file);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_contains(result.out, "48 of 48 labels have a place");
  const auto json = nlohmann::json::parse(test::read_text(json_file));
  EXPECT_EQ(json["drives"].size(), 2u);
  EXPECT_NEAR(json["all"]["distant"]["standing"]["depth_error_percent"].get<double>(), 10.0, 0.02);
  EXPECT_TRUE(json["all"]["distant"]["moving"]["depth_nees"].is_null());
  for (const auto& [arguments, part] :
       {std::pair<std::string, std::string>{"a b", "see --help"},
        {files + " --classes bike", "bike"},
        {files + " --boxes none.txt", "none.txt"},
        {files + " --classes bus", "places none of the 0 labels"}}) {
    const auto refused = test::run_program(folder, "plumb-eval", "placed " + arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments;
    expect_contains(refused.err, part);
  }
}

TEST(Placement, DrawsDepthErrorAndDeviation) {
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not here";
  PlacedDrive drive;
  add_two_cars(&drive);
  const test::TempFolder folder;
  const auto files = draw_placement({evaluate(&drive)}, folder / "plots", "png");
  ASSERT_EQ(files.size(), 1u);
  EXPECT_GT(std::filesystem::file_size(files[0]), 5000u);
  EXPECT_TRUE(draw_placement({}, folder / "plots", "png").empty());
}

}  // namespace
}  // namespace plumb
