/// Runs plumb-train as a user would.
#include <gtest/gtest.h>

#include <fstream>

#include "modules/chain/model_file_source.hpp"
#include "tests/support/kitti_data.hpp"
#include "tests/support/run_program.hpp"
#include "tests/train/drawn.hpp"

namespace plumb {
namespace {

class TrainProgram : public testing::Test {
 protected:
  test::ProgramResult run(const std::string& arguments) {
    return test::run_program(folder_, "plumb-train", arguments);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void draw(const std::string& drive, std::uint64_t seed) const {
    write_samples(test::draw_drive(drive, 100, seed, 0.01), folder_ / (drive + ".csv"));
  }
  test::TempFolder folder_;
};

TEST_F(TrainProgram, MakesAModelOutOfSamplesThatTheLoaderTakes) {
  for (const char* drive : {"a", "b", "c"}) draw(drive, static_cast<std::uint64_t>(drive[0]));
  const auto result = run("fit " + path("a.csv") + " " + path("b.csv") + " " + path("c.csv") +
                          " --hold-out c --out " + path("m.toml") + " --json " + path("m.json") +
                          " --plots " + path("plots"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const GroundModel model = load_models(path("m.toml")).ground;
  EXPECT_NEAR(model.dense_height.of({}), 1e-4, 5e-5);
  EXPECT_EQ(model.origin.drives, "a b");
  EXPECT_NE(model.origin.command.find("--hold-out c"), std::string::npos);
  EXPECT_EQ(model.origin.command.find('/'),
            std::string::npos);  // Paths mean nothing on another machine.
  EXPECT_NE(result.out.find("points        c"), std::string::npos) << result.out;
  EXPECT_GT(std::filesystem::file_size(path("plots/dense_height.png")), 1000U);
  EXPECT_NE(test::read_text(path("m.json")).find("\"held_out\""), std::string::npos);
}

TEST_F(TrainProgram, SaysWhatIsWrongWithItsInput) {
  draw("a", 1);
  std::ofstream(path("other.csv")) << "seq,x\n1,2\n";
  const struct {
    std::string arguments, says;
  } cases[] = {
      {"", "subcommand"},
      {"fit " + path("none.csv") + " --out " + path("m.toml"), "none.csv"},
      {"fit " + path("other.csv") + " --out " + path("m.toml"),
       "other.csv:1: is not a sample file"},
      {"fit " + path("a.csv") + " --hold-out b --out " + path("m.toml"), "no drive b"},
      {"fit " + path("a.csv") + " --hold-out a --out " + path("m.toml"), "no drive to fit"},
      {"fit " + path("a.csv") + " --out " + path("nowhere/m.toml"), "cannot write"},
      {"sample " + path("none.lcm") + " --out " + path("s.csv"), "none.lcm"},
      {"sample " + path("none.lcm") + " --drive 'a b' --out " + path("s.csv"), "--drive"},
  };
  for (const auto& one : cases) {
    const auto result = run(one.arguments);
    EXPECT_EQ(result.exit_code, 2) << one.arguments;
    EXPECT_NE(result.err.find(one.says), std::string::npos) << one.arguments << ": " << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(path("m.toml")));
}

TEST_F(TrainProgram, SamplesARealDriveOnceAndKeepsTheFile) {
  const auto drive = test::kitti_sequence("odometry/sequences/04_000-050");
  if (drive.empty()) GTEST_SKIP() << test::kNoKitti;
  ASSERT_EQ(test::run_program(folder_, "plumb-kitti2lcm",
                              drive.string() + " --end 12 --out " + path("04.lcm"))
                .exit_code,
            0);
  const std::string arguments = "sample " + path("04.lcm") + " --out " + path("04.csv");
  ASSERT_EQ(run(arguments).exit_code, 0);
  const DriveSamples samples = read_samples(path("04.csv"));
  EXPECT_EQ(samples.drive, "04");
  ASSERT_GE(samples.frames.size(), 10U);
  const Sample& last = samples.frames.back();
  EXPECT_EQ(last.seq, 12.0);
  EXPECT_NEAR(last.true_step_m, 1.33, 0.1);
  EXPECT_NEAR(last.true_height_m, 1.66, 0.03);
  EXPECT_LT(std::abs(last.dense_err_height), 0.08);
  EXPECT_LT(std::abs(last.dense_err_given), 0.03);
  EXPECT_LT(std::abs(last.out_scale_err), 0.05);
  EXPECT_NE(run(arguments).out.find("exists already"), std::string::npos);
}

}  // namespace
}  // namespace plumb
