#include <gtest/gtest.h>

#include "modules/datasets/kitti/pose_file.hpp"
#include "modules/datasets/number_file.hpp"
#include "tests/replay/street_log.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/run_program.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::run_program;
using test::street_events;

class ReplayProgram : public ::testing::Test {
 protected:
  void SetUp() override { test::write_log(log_, street_events()); }
  std::string file(const std::string& name) { return (folder_ / name).string(); }
  test::ProgramResult run(const std::string& arguments) {
    return run_program(folder_, "plumb-replay", arguments);
  }
  test::TempFolder folder_;
  const std::string log_ = (folder_ / "street.lcm").string();
  const std::size_t num_images_ = street_events().size() - 1;
};

TEST_F(ReplayProgram, WritesOneRowPerImageAndPrintsItsSpeed) {
  const auto result = run(log_ + " --poses " + file("p.txt") + " --csv " + file("f.csv") +
                          " --can " + file("c.can"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto poses = read_poses(folder_ / "p.txt");
  ASSERT_EQ(poses.size(), num_images_);
  EXPECT_EQ(poses.front(), PoseMatrix::Identity());
  EXPECT_EQ(read_lines(folder_ / "f.csv").size(), num_images_ + 1);
  EXPECT_GT(read_lines(folder_ / "c.can").size(), num_images_);
  for (const char* part : {"frames/s", "frames by status", "vo stages [ms]", "ground stages [ms]",
                           "median", "p99", "total"}) {
    expect_contains(result.out, part);
  }
}

TEST_F(ReplayProgram, TwoRunsGiveTheSameFiles) {
  for (const char* run_name : {"a", "b"}) {
    const std::string name = run_name;
    ASSERT_EQ(run(log_ + " --no-times --poses " + file(name + ".txt") + " --csv " +
                  file(name + ".csv") + " --can " + file(name + ".can"))
                  .exit_code,
              0);
  }
  for (const char* extension : {".txt", ".csv", ".can"}) {
    const std::string a = test::read_text(folder_ / (std::string("a") + extension));
    EXPECT_FALSE(a.empty());
    EXPECT_EQ(a, test::read_text(folder_ / (std::string("b") + extension))) << extension;
  }
}

TEST_F(ReplayProgram, ATruncatedLogIsReadToWhereItBreaks) {
  const std::string whole = test::read_text(log_);
  folder_.write("cut.lcm", whole.substr(0, whole.size() * 2 / 3));
  ASSERT_EQ(run(log_ + " --poses " + file("whole.txt")).exit_code, 0);
  const auto result = run(file("cut.lcm") + " --poses " + file("cut.txt"));
  EXPECT_EQ(result.exit_code, 2);
  expect_contains(result.err, "cut.lcm: byte ");
  const std::string cut = test::read_text(folder_ / "cut.txt");
  // The cut runs through the image two thirds on.
  EXPECT_EQ(read_lines(folder_ / "cut.txt").size(), num_images_ * 2 / 3 - 1);
  EXPECT_EQ(test::read_text(folder_ / "whole.txt").substr(0, cut.size()), cut);
}

TEST_F(ReplayProgram, ACorruptPlaceCostsItsEventOnlyAndIsReported) {
  std::string bytes = test::read_text(log_);
  const std::size_t middle = bytes.size() / 2;
  const std::size_t sync = bytes.find("\xED\xA1\xDA\x01", middle);
  ASSERT_NE(sync, std::string::npos);
  bytes.replace(sync, 4, "XXXX");
  folder_.write("bad.lcm", bytes);
  const auto result = run(file("bad.lcm") + " --poses " + file("p.txt"));
  EXPECT_EQ(result.exit_code, 2);
  expect_contains(result.err, "bad.lcm: byte " + std::to_string(sync));
  expect_contains(result.out, "1 frames are missing by their numbers");
  EXPECT_EQ(read_lines(folder_ / "p.txt").size(), num_images_ - 1);
}

TEST_F(ReplayProgram, ExitsWithTwoAndOneSentenceOnBadInput) {
  folder_.write("empty.lcm", "");
  folder_.write("text.lcm", "this is no log, it is a text of some length and nothing else\n");
  folder_.write("bad.toml", "[vo]\nno_such_key = 1\n");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "LOG"},
      {log_ + " --frobnicate", "--frobnicate"},
      {log_ + " --seed some", "--seed"},
      {file("none.lcm"), "none.lcm"},
      {folder_.path().string(), "not a regular file"},
      {file("empty.lcm"), "holds no image on CAMERA"},
      {log_ + " --config " + file("bad.toml"), "bad.toml:2"},
      {log_ + " --poses /no/such/p.txt", "/no/such/p.txt"},
      {log_ + " --can /no/such/c.can", "/no/such/c.can"},
      {log_ + " --csv /dev/full", "cannot write /dev/full"},
      {log_ + " --can /dev/full", "No space left on device"}};
  for (const auto& [arguments, expected] : cases) {
    const auto result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    expect_contains(result.err, expected);
  }
  EXPECT_EQ(run(file("text.lcm")).exit_code, 2);
}

TEST_F(ReplayProgram, AnswersHelpAndVersion) {
  const auto help = run("--help");
  EXPECT_EQ(help.exit_code, 0);
  expect_contains(help.out, "Examples");
  EXPECT_EQ(run("--version").exit_code, 0);
}

}  // namespace
}  // namespace plumb
