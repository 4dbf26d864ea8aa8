/// Runs plumb-calibrate as a user would, on rendered drives with a known lens.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.hpp"

namespace plumb {
namespace {

class CalibrateProgram : public testing::Test {
 protected:
  test::ProgramResult run(const std::string& program, const std::string& arguments) {
    return test::run_program(folder_, program, arguments);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// A log of a rendered drive that states a lens without radial terms, whatever it was rendered
  /// with.
  std::string render(const std::string& name, const std::string& options) {
    const auto drive = run("plumb-synth", options + " --size 621x188 --quiet --out " + path(name));
    EXPECT_EQ(drive.exit_code, 0) << drive.err;
    const std::string log = path(name + ".lcm");
    const auto converted =
        run("plumb-kitti2lcm", path(name) + " --residual-k1 0 --residual-k2 0 --out " + log);
    EXPECT_EQ(converted.exit_code, 0) << converted.err;
    return log;
  }
  test::TempFolder folder_;
};

TEST_F(CalibrateProgram, FindsTheLensAndTheHeightThatADriveWasRenderedWith) {
  const std::string log = render("turns", "--route city --frames 110 --seed 5 --residual-k1 0.03");
  const auto result = run("plumb-calibrate", log + " --parameters k1 --out " + path("rig.toml") +
                                                 " --json " + path("rig.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(test::read_text(path("rig.json")));
  const auto& k1 = json["lens"]["k1"];
  ASSERT_TRUE(k1["observed"]) << result.out;
  EXPECT_NEAR(k1["value"].get<double>(), 0.03, 0.01);
  EXPECT_NEAR(k1["value"].get<double>(), 0.03, 4.0 * k1["std"].get<double>());
  EXPECT_LT(json["residual_px"].get<double>(), json["stated_residual_px"].get<double>());
  ASSERT_TRUE(json["mount"]["height_m"]["observed"]) << result.out;
  EXPECT_NEAR(json["mount"]["height_m"]["value"].get<double>(), 1.65, 0.05);
  // The written file is a configuration that the programs accept.
  const auto replay =
      run("plumb-replay", log + " --config " + path("rig.toml") + " --poses " + path("p.txt"));
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_NE(test::read_text(path("rig.toml")).find("residual_k1 = 0.0"), std::string::npos);
}

TEST_F(CalibrateProgram, SaysWhatAShortStraightDriveCannotTell) {
  const std::string log = render("straight", "--route motorway --frames 40 --seed 6");
  const auto result = run("plumb-calibrate", log + " --json " + path("rig.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(test::read_text(path("rig.json")));
  for (const char* key : {"k1", "k2"}) {
    EXPECT_FALSE(json["lens"][key]["observed"].get<bool>());
    EXPECT_EQ(json["lens"][key]["value"].get<double>(), 0.0);
  }
  EXPECT_FALSE(json["mount"]["pitch_deg"]["observed"].get<bool>());
  EXPECT_NE(result.out.find("not observed"), std::string::npos);
}

TEST_F(CalibrateProgram, RefusesWhatItCannotUse) {
  std::ofstream(path("empty.lcm")).close();
  const struct {
    std::string arguments, says;
  } cases[] = {
      {"", "LOG"},
      {path("none.lcm"), "none.lcm"},
      {path("empty.lcm"), "the file is empty"},
      {path("empty.lcm") + " --parameters tilt", "none of k1, k2, focal, row"},
      {path("empty.lcm") + " --max-images 3", "--max-images"},
  };
  for (const auto& one : cases) {
    const auto result = run("plumb-calibrate", one.arguments);
    EXPECT_EQ(result.exit_code, 2) << one.arguments;
    EXPECT_NE(result.err.find(one.says), std::string::npos) << one.arguments << ": " << result.err;
  }
}

}  // namespace
}  // namespace plumb
