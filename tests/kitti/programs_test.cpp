#include <gtest/gtest.h>

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

}  // namespace
}  // namespace plumb
