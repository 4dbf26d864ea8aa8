#include <gtest/gtest.h>

#include "platform/bounded_decode.hpp"
#include "platform/log_file.hpp"
#include "plumb/detections_t.hpp"
#include "plumb_paths.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/kitti_data.hpp"
#include "tests/support/kitti_folder.hpp"
#include "tests/support/run_program.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::run_program;

std::int64_t count_sound_events(const std::filesystem::path& path) {
  LogReader reader(path.string());
  LogEvent event;
  while (reader.next(&event)) {
  }
  EXPECT_EQ(reader.num_problems(), 0) << path;
  return reader.num_events();
}

TEST(Kitti2LcmProgram, ExitsWithTwoAndOneSentenceOnBadInput) {
  const test::TempFolder folder;
  const std::string seq = test::write_odometry(folder, 3).string();
  const std::string out = " --out " + (folder / "o.lcm").string();
  folder.write("empty/calib.txt", test::kCalibration);
  std::filesystem::create_directories(folder / "empty/image_0");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "SEQ_DIR"},
      {seq, "--out"},
      {seq + out + " --speed 3", "--speed"},
      {seq + out + " --compress zip", "zip"},
      {seq + out + " --camera 4", "--camera"},
      {seq + out + " --residual-k1 much", "--residual-k1"},
      {seq + out + " --camera 2", "neither image_2 nor image_02/data"},
      {seq + out + " --poses " + seq + "/none.txt", "none.txt"},
      {(folder / "empty").string() + out, "has no image"},
      {(folder / "nothing").string() + out, "is not a folder"},
      {seq + " --out " + (folder / "no/such/o.lcm").string(), "cannot write"}};
  for (const auto& [arguments, expected] : cases) {
    test::expect_refused(folder, "plumb-kitti2lcm", arguments, expected);
  }
}

TEST(Kitti2LcmProgram, GivesBoxesTheirCandidates) {
  const test::TempFolder folder;
  const std::string seq = test::write_odometry(folder, 3).string();
  const std::string boxes =
      folder.write("b.txt", "1 4 Car -1 -1 -10 10 10 40 30 -1 -1 -1 -1 -1 -1 -1\n").string();
  const std::string candidates =
      folder.write("c.txt", "1 Car 11 10 41 30 0.75\n1 Car 60 10 80 30 0.9\n").string();
  const std::string out = " --candidates " + candidates + " --out " + (folder / "o.lcm").string();
  test::expect_refused(folder, "plumb-kitti2lcm", seq + out, "--candidates belong to boxes");
  const auto result = run_program(folder, "plumb-kitti2lcm", seq + out + " --detections " + boxes);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  LogReader reader((folder / "o.lcm").string());
  LogEvent event;
  int num_candidates = 0;
  while (reader.next(&event)) {
    detections_t message;
    if (event.channel != "DETECTIONS" || !decode_bounded(event.data, &message)) continue;
    for (const detection_t& detection : message.detections) {
      num_candidates += detection.num_candidates;
      EXPECT_FLOAT_EQ(detection.candidate_scores[0], 0.75F);
      EXPECT_FLOAT_EQ(detection.candidates_px[0][0], 11.0F);
    }
  }
  EXPECT_EQ(num_candidates, 1);
}

TEST(Kitti2LcmProgram, AFullDiskLeavesASoundLogAndOneSentence) {
  const test::TempFolder folder;
  const std::string seq = test::write_odometry(folder, 400).string();
  std::filesystem::create_directories(folder / "small");
  const std::string mount = "mount -t tmpfs -o size=1500k none " + (folder / "small").string();
  if (std::system(("unshare -rm sh -c '" + mount + "' 2>/dev/null").c_str()) != 0) {
    GTEST_SKIP() << "no private mount namespace here";
  }
  // The log is in a file system of the namespace, so the script copies out what is left of it.
  const std::string script =
      folder
          .write("full.sh", mount + " || exit 9\n\"$1\" " + seq + " --out " +
                                (folder / "small/o.lcm").string() + "\ncode=$?\ncp " +
                                (folder / "small/o.lcm").string() + " " +
                                (folder / "o.lcm").string() + "\nexit $code\n")
          .string();
  const std::string err = (folder / "err.txt").string();
  const int status = std::system(
      ("unshare -rm sh " + script + " " PLUMB_BIN_DIR "/plumb-kitti2lcm >/dev/null 2>" + err)
          .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  expect_contains(test::read_text(err), "No space left on device");
  EXPECT_GT(count_sound_events(folder / "o.lcm"), 20);
}

TEST(Kitti2LcmProgram, ConvertsARealDrive) {
  const auto seq = test::kitti_sequence("odometry/sequences/05_100-159");
  if (seq.empty()) GTEST_SKIP() << test::kNoKitti;
  const test::TempFolder folder;
  const auto result = run_program(folder, "plumb-kitti2lcm",
                                  seq.string() + " --out " + (folder / "o.lcm").string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_contains(result.out, "60 frames");
  EXPECT_EQ(count_sound_events(folder / "o.lcm"), 60 + 60 + 6)
      << "an image, its truth, and a calibration every ten frames of 0.104 s";
}

TEST(Kitti2LcmProgram, AnswersHelpAndVersion) {
  const test::TempFolder folder;
  const auto help = run_program(folder, "plumb-kitti2lcm", "--help");
  EXPECT_EQ(help.exit_code, 0);
  expect_contains(help.out, "Examples");
  EXPECT_EQ(run_program(folder, "plumb-kitti2lcm", "--version").exit_code, 0);
}

}  // namespace
}  // namespace plumb
