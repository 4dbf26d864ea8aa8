/// Runs plumb-synth as a user would.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/support/run_program.hpp"

namespace {

namespace fs = std::filesystem;

class SynthProgram : public testing::Test {
 protected:
  struct Ran {
    int code;
    std::string text;  ///< of both streams
  };
  Ran run(const std::string& arguments) const {
    const auto result = plumb::test::run_program(folder_, "plumb-synth", arguments);
    return {result.exit_code, result.out + result.err};
  }
  fs::path fresh(const std::string& name) const { return folder_ / ("synth_" + name); }
  plumb::test::TempFolder folder_;
};

using plumb::test::read_text;

int lines(const fs::path& file, bool comments) {
  std::ifstream in(file);
  int count = 0;
  for (std::string line; std::getline(in, line);) count += (line[0] == '#') == comments ? 1 : 0;
  return count;
}

const std::string kSmall = " --size 310x94 --frames 5 --quiet --seed 9 ";

TEST_F(SynthProgram, FilesDoNotDependOnTheNumberOfThreads) {
  const fs::path one = fresh("one");
  const fs::path three = fresh("three");
  ASSERT_EQ(run("--out " + one.string() + kSmall + "--threads 1 --traffic 4").code, 0);
  ASSERT_EQ(run("--out " + three.string() + kSmall + "--threads 3 --traffic 4").code, 0);
  int compared = 0;
  for (const auto& entry : fs::recursive_directory_iterator(one)) {
    if (!entry.is_regular_file()) continue;
    const fs::path other = three / fs::relative(entry.path(), one);
    EXPECT_EQ(read_text(entry.path()), read_text(other)) << other;
    ++compared;
  }
  EXPECT_EQ(compared, 5 + 6);
  const fs::path seeded = fresh("seeded");
  ASSERT_EQ(run("--out " + seeded.string() + " --size 310x94 --frames 1 --quiet --seed 10").code,
            0);
  EXPECT_NE(read_text(seeded / "image_0/000000.png"), read_text(one / "image_0/000000.png"));
}

TEST_F(SynthProgram, ACodedDriveDoesNotDependOnTheNumberOfThreads) {
  const std::string options =
      kSmall + "--route freeway --rate 20 --dense 15 --dashboard 0.2 --reflections 1 --stamp ";
  const auto image = [&](const std::string& name, const std::string& more) {
    EXPECT_EQ(run("--out " + fresh(name).string() + options + more).code, 0);
    return read_text(fresh(name) / "image_0/000004.png");
  };
  const std::string coded = image("one", "--compression 6 --threads 1");
  EXPECT_EQ(coded, image("three", "--compression 6 --threads 3"));
  const std::string plain = image("plain", "--threads 1");
  EXPECT_NE(coded, plain);
  EXPECT_LT(coded.size(), plain.size()) << "less detail is left";
}

TEST_F(SynthProgram, LayoutIsKittisAndTruthHasARowPerFrame) {
  const fs::path out = fresh("layout");
  ASSERT_EQ(run("--out " + out.string() + kSmall +
                "--residual-k1 0.01 --residual-k2 -0.004 --rolling-shutter 0.01")
                .code,
            0);
  for (const char* name : {"times.txt", "poses.txt", "gt_ground_plane.txt", "vehicle.txt"})
    EXPECT_EQ(lines(out / name, false), 5) << name;
  const cv::Mat image = cv::imread((out / "image_0/000004.png").string(), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(image.type(), CV_8UC1);
  EXPECT_EQ(image.cols, 310);
  EXPECT_EQ(image.rows, 94);
  const std::string calibration = read_text(out / "calib.txt");
  for (const char* row : {"P0: ", "P1: ", "P2: ", "P3: ", "residual_k1: 0.01\n",
                          "residual_k2: -0.004\n", "readout_s: 0.01\n"})
    EXPECT_NE(calibration.find(row), std::string::npos) << row;
  std::ifstream poses(out / "poses.txt");
  for (const double expected : {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0}) {
    double value = 9.0;
    poses >> value;
    EXPECT_NEAR(value, expected, 1e-12);
  }
  std::ifstream planes(out / "gt_ground_plane.txt");
  std::string comment;
  std::getline(planes, comment);
  int frame = 0;
  double n[3] = {};
  double height = 0.0;
  planes >> frame >> n[0] >> n[1] >> n[2] >> height;
  EXPECT_EQ(frame, 0);
  EXPECT_GT(n[1], 0.99) << "the normal points down";
  EXPECT_NEAR(height, 1.65, 0.12);
}

TEST_F(SynthProgram, RefusesWhatItCannotDoInOneSentence) {
  const fs::path out = fresh("refused");
  for (const std::string wrong :
       {"--route nowhere", "--frames 0", "--size 12", "--rate abc", "--unknown 1", "--tunnel 5:2",
        "--poses /nonexistent.txt", "--start 4", "--lead bus", "--wall left", "--wall up",
        "--tube 90:30", "--dense -1"}) {
    const Ran ran = run("--out " + out.string() + " " + wrong);
    EXPECT_EQ(ran.code, 2) << wrong << ": " << ran.text;
    EXPECT_EQ(std::count(ran.text.begin(), ran.text.end(), '\n'), 1) << ran.text;
  }
  EXPECT_EQ(run("").code, 2);
  EXPECT_EQ(run("stats /nonexistent").code, 2);
  EXPECT_FALSE(fs::exists(out / "calib.txt"));
}

TEST_F(SynthProgram, KeepsAFolderThatIsNotEmptyUnlessForced) {
  const fs::path out = fresh("kept");
  fs::create_directories(out);
  std::ofstream(out / "notes.txt") << "mine";
  EXPECT_EQ(run("--out " + out.string() + kSmall).code, 2);
  EXPECT_FALSE(fs::exists(out / "image_0"));
  EXPECT_EQ(run("--out " + out.string() + kSmall + "--force").code, 0);
  EXPECT_EQ(read_text(out / "notes.txt"), "mine");
  EXPECT_TRUE(fs::exists(out / "image_0/000004.png"));
}

TEST_F(SynthProgram, ListsItsRoutesAndMeasuresADrive) {
  const Ran routes = run("--list-routes");
  EXPECT_EQ(routes.code, 0);
  for (const char* name : {"city", "straight", "motorway", "loop", "stop-and-go", "stop",
                           "standing", "freeway", "jam", "roundabout", "inner-city"})
    EXPECT_NE(routes.text.find(name), std::string::npos) << name;
  EXPECT_EQ(run("--version").code, 0);
  EXPECT_EQ(run("--help").code, 0);
  const fs::path out = fresh("measured");
  ASSERT_EQ(run("--out " + out.string() + " --size 621x188 --frames 12 --quiet").code, 0);
  const Ran stats = run("stats " + out.string());
  EXPECT_EQ(stats.code, 0) << stats.text;
  EXPECT_NE(stats.text.find("| synth_measured | 12 |"), std::string::npos) << stats.text;
}

}  // namespace
