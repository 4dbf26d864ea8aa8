#include <gtest/gtest.h>

#include <string>

#include "tests/support/expect_throw.hpp"
#include "tests/support/run_program.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::run_program;

TEST(KittiPrograms, RefuseInOneSentence) {
  const test::TempFolder folder;
  const std::string here = folder.path().string();
  const auto no_scans = run_program(folder, "plumb-planes", here + " --out p.txt");
  EXPECT_EQ(no_scans.exit_code, 2);
  expect_contains(no_scans.err, "has neither velodyne nor velodyne_points/data");
  folder.write("velodyne/readme.txt", "");
  const auto empty = run_program(folder, "plumb-planes", here + " --out p.txt");
  EXPECT_EQ(empty.exit_code, 2);
  const auto same = run_program(folder, "plumb-trial", "a.lcm --out a.lcm");
  EXPECT_EQ(same.exit_code, 2);
  expect_contains(same.err, "would overwrite");
  const auto wrong = run_program(folder, "plumb-trial", "a.lcm --nois 2");
  expect_contains(wrong.err, "did you mean --noise?");
}

TEST(KittiPrograms, FitNothingToAScanWithoutARoad) {
  const test::TempFolder folder;
  folder.write("calib.txt", "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
  folder.write("velodyne/000000.bin", std::string(16 * 200, '\0'));
  const auto result = run_program(folder, "plumb-planes",
                                  folder.path().string() + " --out " + (folder / "p.txt").string());
  EXPECT_EQ(result.exit_code, 2);
  expect_contains(result.err, "shows a road");
}

TEST(KittiPrograms, SayWhichOfTwoErrorsIsSmaller) {
  const test::TempFolder folder;
  std::string poses, rows =
                         "seq,vo_status,scale_epoch,vo_t_x,vo_t_y,vo_t_z,plane_status,log_scale,"
                         "dense_status,dense_height_vo,points_status,points_height_vo\n";
  for (int k = 0; k < 40; ++k) {
    poses += "1 0 0 0 0 1 0 0 0 0 1 " + std::to_string(k) + "\n";
    rows += std::to_string(k) + ",ok,0,0,0,0.5,ok,0.673344553,used,0.84,failed,\n";
  }
  folder.write("poses.txt", poses);
  folder.write("04.csv", rows);
  const std::string at = folder.path().string() + "/";
  const auto height = run_program(folder, "plumb-eval",
                                  "height " + at + "poses.txt " + at + "04.csv --samples " + at +
                                      "s.csv --json " + at + "h.json");
  ASSERT_EQ(height.exit_code, 0) << height.err;
  expect_contains(height.out, "fused        40 frames  mean   2.000 %");
  const std::string files = "compare " + at + "s.csv " + at + "s.csv ";
  const auto compare = run_program(folder, "plumb-eval", files + "--of fused --against constant");
  ASSERT_EQ(compare.exit_code, 0) << compare.err;
  expect_contains(compare.out, "40 pairs in 2 blocks");
  expect_contains(compare.out, "difference    2.0000      2.0000 ..    2.0000");
  expect_contains(run_program(folder, "plumb-eval", files + "--of fused").err, "go together");
  expect_contains(run_program(folder, "plumb-eval", files + "--of fused --against nothing").err,
                  "no sample in common");
}

}  // namespace
}  // namespace plumb
