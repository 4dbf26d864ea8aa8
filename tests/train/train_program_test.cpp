/// Runs plumb-train as a user would.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/channels.hpp"
#include "modules/chain/model_file_source.hpp"
#include "modules/detections/detections_wire.hpp"
#include "platform/bounded_decode.hpp"
#include "platform/log_file.hpp"
#include "plumb_paths.hpp"
#include "tests/support/kitti_data.hpp"
#include "tests/support/run_program.hpp"
#include "tests/train/drawn.hpp"
#include "tools/learn/train/box_samples.hpp"

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

/// The demo drive's first images, with boxes whose candidates' scores fall off around them.
void write_drive_with_candidates(const std::string& path, int num_images) {
  LogReader reader(PLUMB_SOURCE_DIR "/tools/run/demo_drive/drive.lcm");
  LogWriter writer(path);
  LogEvent event;
  std::vector<std::uint8_t> bytes;
  for (int images = 0; images < num_images && reader.next(&event);) {
    images += event.channel == kCamera.name ? 1 : 0;
    detections_t message;
    if (event.channel != kDetections.name || !decode_bounded(event.data, &message)) {
      writer.write(event.log_us, event.channel, event.data);
      continue;
    }
    DetectionFrame frame;
    ASSERT_EQ(from_wire(message, &frame), nullptr);
    for (Detection& detection : frame.detections) {
      for (int k = 0; k < 16; ++k) {
        Candidate candidate{detection.box, 0.0};
        const double down_px = 2.0 * std::sin(1.7 * k), taller_px = 3.0 * std::cos(2.9 * k);
        candidate.box.top_px += down_px - taller_px;
        candidate.box.bottom_px += down_px;
        candidate.score = 0.9 * std::exp(-0.1 * (down_px * down_px + taller_px * taller_px));
        (void)detection.candidates.push_back(candidate);
      }
    }
    to_wire(frame, &message);
    bytes.resize(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    writer.write(event.log_us, event.channel, bytes);
  }
  writer.close();
}

TEST_F(TrainProgram, ShowsTheObjectsAndOneImageOfThePublishedMethod) {
  write_drive_with_candidates(path("d.lcm"), 24);
  const auto boxes = run("boxes " + path("d.lcm") + " --out " + path("boxes.csv"));
  ASSERT_EQ(boxes.exit_code, 0) << boxes.err;
  const std::vector<BoxSample> samples = read_box_samples(path("boxes.csv"));
  ASSERT_GE(samples.size(), 20U);
  for (const BoxSample& sample : samples) {
    EXPECT_GT(sample.confidence_px2, 0.0);
    EXPECT_LT(std::abs(sample.error_n3), 0.1);
    EXPECT_GT(sample.distance_m, 3.0);
  }
  std::ofstream(path("paper.toml")) << "[ground]\nmode = \"paper\"\n";
  const std::string arguments = "example " + path("d.lcm") + " --json " + path("e.json");
  EXPECT_NE(run(arguments).err.find("ground.mode is not"), std::string::npos);
  const auto example = run(arguments + " --frame 8 --config " + path("paper.toml"));
  ASSERT_EQ(example.exit_code, 0) << example.err;
  const auto json = nlohmann::json::parse(test::read_text(path("e.json")));
  EXPECT_GE(json["seq"], 8);
  ASSERT_EQ(json["slices"].size(), 3U);
  for (const auto& slice : json["slices"]) {
    ASSERT_EQ(slice["x"].size(), 50U);
    // The plane that was found lies in the middle of the slice, and nothing is lower than it.
    const double middle = 0.5 * (slice["cost"][24].get<double>() + slice["cost"][25].get<double>());
    EXPECT_LT(middle, slice["cost"][0]);
    EXPECT_LT(middle, slice["cost"][49]);
  }
  EXPECT_EQ(json["object"]["candidates"].size(), 16U);
  EXPECT_GT(json["object"]["confidence_px2"], 0.0);
}

TEST_F(TrainProgram, FitsTheObjectsLineOfThePublishedMethodToFilesOfBoxes) {
  DriveSamples drive = test::draw_drive("a", 100, 1, 0.01);
  drive.algorithm = "paper";
  write_samples(drive, path("a.csv"));
  std::ofstream file(path("boxes.csv"));
  file << "seq,objects_confidence,objects_error,distance_m\n0,,0.5,20\n";
  for (int k = 0; k < 400; ++k) {
    const double confidence = 1.0 + 0.01 * k;
    file << k << "," << confidence << ","
         << (k % 2 == 0 ? 1.0 : -1.0) * std::sqrt(1e-4 * confidence) << ",20\n";
  }
  file.close();
  const std::string fit = "fit " + path("a.csv") + " --out " + path("m.toml");
  const auto result = run(fit + " --boxes " + path("boxes.csv"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("objects n3"), std::string::npos) << result.out;
  const LinearVariance line = load_models(path("m.toml")).paper.objects_n3;
  EXPECT_NEAR(line.slope, 1e-4, 1e-6);
  EXPECT_NEAR(line.of(2.0), 2e-4, 1e-5);
  ASSERT_EQ(run(fit).exit_code, 0);
  EXPECT_EQ(load_models(path("m.toml")).paper.objects_n3.mean,
            built_in_paper_model().objects_n3.mean);
  draw("b", 2);
  EXPECT_NE(
      run("fit " + path("b.csv") + " --out " + path("m.toml") + " --boxes " + path("boxes.csv"))
          .err.find("not of the published method"),
      std::string::npos);
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
