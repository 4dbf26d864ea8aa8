#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/support/expect_throw.hpp"
#include "tests/support/run_program.hpp"
#include "tests/tools/drives.hpp"

namespace plumb {
namespace {

using test::drive_step;
using test::expect_contains;
using test::repeat;
using test::run_program;
using test::to_file;

TEST(EvalProgram, PrintsATableAndWritesTheSameFiguresAsJson) {
  const test::TempFolder folder;
  const auto gt = folder.write("gt.txt", to_file(repeat(drive_step(1.0), 31)));
  const auto est = folder.write("est.txt", to_file(repeat(drive_step(1.1), 31)));
  const auto result = run_program(
      folder, "plumb-eval",
      gt.string() + " " + est.string() + " --lengths 10 --json " + (folder / "e.json").string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_contains(result.out, "11.000");
  const auto json = nlohmann::json::parse(test::read_text(folder / "e.json"));
  EXPECT_NEAR(json["pooled"]["t_percent"].get<double>(), 11.0, 1e-6);
  EXPECT_EQ(json["sequences"][0]["scale_steps"]["num"].get<int>(), 30);
  EXPECT_NEAR(json["sequences"][0]["scale_windows"]["median"].get<double>(), 1.1, 1e-6);
}

TEST(EvalProgram, DrawsTrajectoryAndErrors) {
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not here";
  const test::TempFolder folder;
  // WHEN a name has what gnuplot or a shell would take for its own:
  const auto gt = folder.write("it's $x_1.txt", to_file(repeat(drive_step(1.0, 0.01), 61)));
  for (const std::string format : {"svg", "png"}) {
    const std::string file_word = test::shell_word(gt.string());
    const auto result = run_program(folder, "plumb-eval",
                                    file_word + " " + file_word + " --lengths 10,20 --plots " +
                                        (folder / "plots").string() + " --plot-format " + format);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    for (const std::string name :
         {"it's $x_1_trajectory.", "error_by_length.", "error_by_speed."}) {
      const auto file = folder / "plots" / (name + format);
      ASSERT_TRUE(std::filesystem::exists(file)) << file;
      EXPECT_GT(std::filesystem::file_size(file), 3000U) << file;
    }
  }
}

TEST(EvalProgram, ComparesPlanes) {
  const test::TempFolder folder;
  const auto gt = folder.write("plane.txt", "0 0 1 0 1.5\n1 0 1 0 1.5\n");
  const auto est = folder.write(
      "e.csv",
      "seq,plane_status,height_m,pitch_rad,roll_rad\n0,ok,1.65,0,0\n1,held,1.5,0.0349066,0\n");
  const auto result = run_program(
      folder, "plumb-eval",
      "plane " + gt.string() + " " + est.string() + " --json " + (folder / "p.json").string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(test::read_text(folder / "p.json"));
  EXPECT_NEAR(json["height_error_mean_percent"].get<double>(), 5.0, 1e-9);
  EXPECT_NEAR(json["pitch"]["mean_deg"].get<double>(), 1.0, 1e-4);
  EXPECT_TRUE(json["height_calibration"]["nees"].is_null());
}

TEST(EvalProgram, ExitsWithTwoAndOneSentenceOnBadInput) {
  const test::TempFolder folder;
  const auto gt = folder.write("gt.txt", to_file(repeat(drive_step(1.0), 31))).string();
  const auto shorter = folder.write("short.txt", to_file(repeat(drive_step(1.0), 30))).string();
  const auto text = folder.write("text.txt", "not a pose\n").string();
  const auto csv = folder.write("e.csv", "seq,height_m,pitch_rad,roll_rad\n9,1,0,0\n").string();
  const auto plane = folder.write("plane.txt", "0 0 1 0 1.5\n").string();
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "see --help"},
      {gt, "see --help"},
      {"--frobnicate", "--frobnicate"},
      {gt + " " + (folder / "none.txt").string(), "none.txt"},
      {gt + " " + shorter, "--allow-partial"},
      {gt + " " + text, "text.txt:1"},
      {gt + " " + gt + " --lengths 10,fast", "'fast'"},
      {gt + " " + gt + " --lengths 0", "'0'"},
      {gt + " " + gt + " --step 0", "--step"},
      {gt + " " + gt + " --json /nowhere/e.json", "/nowhere/e.json"},
      {"plane " + plane + " " + csv, "no frame of"},
      {"plane " + plane, "EST_CSV"}};
  for (const auto& [arguments, expected] : cases) {
    test::expect_refused(folder, "plumb-eval", arguments, expected);
  }
}

TEST(EvalProgram, AnswersHelpAndVersion) {
  const test::TempFolder folder;
  const auto help = run_program(folder, "plumb-eval", "--help");
  EXPECT_EQ(help.exit_code, 0);
  expect_contains(help.out, "Examples");
  EXPECT_EQ(run_program(folder, "plumb-eval", "--version").exit_code, 0);
}

}  // namespace
}  // namespace plumb
