/// Tests plumb-convert as a user runs it.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/channels.hpp"
#include "core/principal_point.hpp"
#include "modules/camera/image_wire.hpp"
#include "platform/bounded_decode.hpp"
#include "platform/log_file.hpp"
#include "tests/camera/pattern.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/kitti_data.hpp"
#include "tests/support/kitti_folder.hpp"
#include "tests/support/run_program.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::test_image;

constexpr std::int64_t kEpoch_us = 1'000'000'000'000'000;
constexpr const char* kCamera96 =
    "[camera]\nfx_px = 80.0\nfy_px = 81.0\ncx_px = 47.0\ncy_px = 35.0\ncamera_height_m = 1.5\n";

struct LoggedImage {
  std::int64_t capture_us = 0;
  std::int64_t seq = 0;
  bool compressed = false;
  cv::Mat pixels;
};

struct Log {
  std::vector<LoggedImage> images;
  std::vector<camera_calibration_t> calibrations;
};

LoggedImage to_image(std::span<const std::uint8_t> bytes) {
  ImageFrame frame;
  EXPECT_EQ(read_image(bytes, &frame), nullptr);
  ImageDecoder decoder(frame.width_px, frame.height_px);
  ImageView view;
  EXPECT_EQ(decoder.decode(frame, &view), nullptr);
  const cv::Mat pixels(view.height_px, view.width_px, CV_8U, const_cast<std::uint8_t*>(view.data),
                       static_cast<std::size_t>(view.stride_bytes));
  return {frame.capture_us, frame.seq, frame.compressed, pixels.clone()};
}

Log read_log(const std::filesystem::path& path) {
  LogReader reader(path.string());
  Log log;
  for (LogEvent event; reader.next(&event);) {
    if (event.channel == kCamera.name) {
      log.images.push_back(to_image(event.data));
      EXPECT_EQ(log.images.back().capture_us, event.log_us);
    } else {
      EXPECT_EQ(event.channel, kCameraCalibration.name);
      EXPECT_TRUE(decode_bounded(event.data, &log.calibrations.emplace_back()));
      EXPECT_EQ(log.calibrations.back().utime, event.log_us);
    }
  }
  EXPECT_EQ(reader.num_problems(), 0) << path;
  return log;
}

class ConvertProgram : public ::testing::Test {
 protected:
  /// Writes images/frame_N.png for N from 8 on, and the camera file beside the folder.
  void SetUp() override {
    for (int i = 8; i < 20; ++i)
      test::write_image(folder_, format("images/frame_%d.png", i), test_image(i));
    folder_.write("camera.toml", kCamera96);
  }
  /// Writes smooth images as MJPEG in AVI, at 20 frames/s.
  [[nodiscard]] std::string write_video(int num_frames) const {
    const std::string path = (folder_ / "drive.avi").string();
    cv::VideoWriter writer(path, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                           20.0, cv::Size(96, 72));
    for (int i = 0; i < num_frames; ++i) {
      cv::Mat colour;
      cv::cvtColor(cv::Mat(72, 96, CV_8U, cv::Scalar(40 + 10 * i)), colour, cv::COLOR_GRAY2BGR);
      writer.write(colour);
    }
    return path;
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  /// Converts images/ at 10 images/s to out.lcm.
  [[nodiscard]] test::ProgramResult run(const std::string& arguments = "--rate 10") const {
    return test::run_program(folder_, "plumb-convert",
                             path("images") + " --out " + path("out.lcm") + " " + arguments);
  }
  [[nodiscard]] Log log() const { return read_log(folder_ / "out.lcm"); }
  test::TempFolder folder_;
};

TEST_F(ConvertProgram, ConvertsAFolderOfImages) {
  std::filesystem::remove(folder_ / "images/frame_18.png");
  const test::ProgramResult result = run();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_contains(result.out, "11 frames of 96x72, 1.1 s");
  expect_contains(result.out, "camera from " + path("camera.toml"));
  EXPECT_EQ(result.err, "plumb-convert: 1 image is missing before frame_19.png\n");
  const Log log = this->log();
  ASSERT_EQ(log.images.size(), 11U);
  for (const LoggedImage& image : log.images) {
    EXPECT_EQ(image.capture_us, kEpoch_us + 100'000 * (image.seq - 8));
    EXPECT_EQ(cv::norm(image.pixels, test_image(static_cast<int>(image.seq)), cv::NORM_INF), 0.0);
  }
  EXPECT_EQ(log.images.back().seq, 19);
  ASSERT_EQ(log.calibrations.size(), 2U) << "at the beginning and a second later";
  EXPECT_EQ(log.calibrations[1].utime, kEpoch_us + 1'100'000);
  EXPECT_EQ(log.calibrations[0].width, 96);
  EXPECT_EQ(log.calibrations[0].fy_px, 81.0);
  EXPECT_EQ(log.calibrations[0].cx_px, 47.0);
  EXPECT_EQ(log.calibrations[0].camera_height_m, 1.5);
}

TEST_F(ConvertProgram, ConvertsAVideo) {
  const test::ProgramResult result = test::run_program(
      folder_, "plumb-convert", write_video(8) + " --out " + path("out.lcm") + " --compress jpeg");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Log log = this->log();
  ASSERT_EQ(log.images.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    const LoggedImage& image = log.images[i];
    EXPECT_EQ(image.seq, static_cast<std::int64_t>(i));
    EXPECT_NEAR(static_cast<double>(image.capture_us), 50'000.0 * static_cast<double>(i), 1'000.0);
    EXPECT_TRUE(image.compressed);
    EXPECT_NEAR(image.pixels.at<std::uint8_t>(30, 40), 40 + 10 * static_cast<int>(i), 3);
  }
}

TEST_F(ConvertProgram, TakesThePartBetweenStartAndEnd) {
  // What follows the end is not read.
  folder_.write("images/frame_13.png", "no image");
  ASSERT_EQ(run("--rate 10 --start 11 --end 12").exit_code, 0);
  const Log log = this->log();
  ASSERT_EQ(log.images.size(), 2U);
  EXPECT_EQ(log.images[0].seq, 11);
  EXPECT_EQ(log.images[0].capture_us, kEpoch_us + 300'000) << "as in the log of the whole folder";
  EXPECT_EQ(log.calibrations.size(), 1U);
}

TEST_F(ConvertProgram, RectifiesAndMasksAsTheCameraFileSays) {
  cv::Mat mask(72, 96, CV_8U, cv::Scalar(0));
  mask.rowRange(52, 72).setTo(255);
  test::write_image(folder_, "bonnet.png", mask);
  folder_.write("camera.toml", std::string(kCamera96) + "k1 = -0.2\nmask_file = \"bonnet.png\"\n" +
                                   "rectified_fx_px = 70.0\n");
  ASSERT_EQ(run().exit_code, 0);
  const Log log = this->log();
  EXPECT_EQ(log.calibrations.front().fx_px, 70.0);
  const cv::Mat& image = log.images.front().pixels;
  EXPECT_GT(cv::norm(image.rowRange(0, 40), test_image(8).rowRange(0, 40), cv::NORM_INF), 5.0);
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(image.rowRange(52, 72), &low, &high);
  EXPECT_EQ(low, high);
}

TEST_F(ConvertProgram, WarnsOfWhatWillFailLater) {
  for (int i = 8; i < 20; ++i)
    test::write_image(folder_, format("images/frame_%d.png", i), cv::Mat::zeros(72, 96, CV_8U));
  folder_.write("camera.toml",
                "[camera]\nfx_px = 80.0\nfy_px = 80.0\ncx_px = 20.0\ncy_px = 35.0\n");
  const test::ProgramResult result = run();
  EXPECT_EQ(result.exit_code, 0);
  expect_contains(result.err, "warning: 10 frames are black, flat or frozen");
  expect_contains(result.err, kPrincipalPointIsOff);
  expect_contains(result.err, "states no camera_height_m");
}

TEST_F(ConvertProgram, ADamagedImageEndsASoundLog) {
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", test_image(10), jpeg);
  folder_.write("images/frame_10.png", std::string(jpeg.begin(), jpeg.begin() + 800));
  const test::ProgramResult result = run();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "plumb-convert: " + path("images/frame_10.png") +
                            " is cut off before the image ends; " + path("out.lcm") +
                            " holds the 2 frames before it\n");
  EXPECT_EQ(log().images.size(), 2U);
}

TEST_F(ConvertProgram, ExitsWithTwoAndOneSentenceOnBadInput) {
  folder_.write("blind.toml", "[camera]\nwidth_px = 96\n");
  folder_.write("centre.toml", "[camera]\nfx_px = 80.0\nfy_px = 80.0\ncx_px = 48.0\n");
  folder_.write("size.toml", std::string(kCamera96) + "width_px = 640\n");
  folder_.write("key.toml", "[camera]\nfocal = 80.0\n");
  folder_.write("mask.toml", std::string(kCamera96) + "mask_file = \"none.png\"\n");
  folder_.write("calib.txt", "P0: 80 0 48 0 0 80 36 0 0 0 1 0\nresidual_k1: 5\n");
  folder_.write("deep/times.txt", "0\n");
  test::write_image(folder_, "deep/1.png", cv::Mat(72, 96, CV_16U, cv::Scalar(700)));
  test::write_image(folder_, "large/1.png", cv::Mat(1300, 2000, CV_8U, cv::Scalar(7)));
  folder_.write("text.mp4", "this is text");
  const std::string out = " --out " + path("o.lcm") + " ";
  const std::string folder = path("images") + out + "--rate 10 ";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "RECORDING"},
      {path("images"), "--out"},
      {folder + "--speed 3", "--speed"},
      {folder + "--compress zip", "zip"},
      {folder + "--times t.txt", "excludes"},
      {path("images") + out + "--rate 0", "--rate"},
      {path("images") + out, "state --rate"},
      {path("images") + out + "--times " + path("none.txt"), "none.txt"},
      {path("none") + out, "cannot read " + path("none")},
      {path("text.mp4") + out, "is not a readable video"},
      {write_video(2) + out + "--rate 10", "a file has times of its own"},
      {path("deep") + out, "1.png has 16 bits per channel"},
      {path("large") + out + "--rate 1", "more pixels than 1920 x 1200"},
      {folder + "--camera " + path("none.toml"), "cannot read"},
      {folder + "--camera " + path("blind.toml"), "blind.toml does not state camera.fx_px"},
      {folder + "--camera " + path("centre.toml"), "centre.toml does not state camera.cy_px"},
      {folder + "--camera " + path("size.toml"), "frame_8.png is 96x72, camera.width_px"},
      {folder + "--camera " + path("key.toml"), "key.toml:2: camera.focal"},
      {folder + "--camera " + path("mask.toml"), "camera.mask_file: cannot read"},
      {folder + "--camera " + path("calib.txt"), "k1 is outside"},
      {folder + "--start 12 --end 11", "--end is before --start"},
      {folder + "--start 100", "no frame of the recording lies between"},
      {path("images") + " --rate 10 --out " + path("no/such/o.lcm"), "cannot write"}};
  for (const auto& [arguments, expected] : cases)
    test::expect_refused(folder_, "plumb-convert", arguments, expected);
  EXPECT_FALSE(std::filesystem::exists(path("o.lcm")));
  std::filesystem::remove(folder_ / "camera.toml");
  std::filesystem::remove(folder_ / "calib.txt");
  test::expect_refused(folder_, "plumb-convert", folder, "no camera file");
}

/// Converts SEQ_DIR with plumb-kitti2lcm and its image_0 with plumb-convert; the logs are equal.
void expect_log_of_kitti2lcm(const test::TempFolder& folder, const std::string& more = "") {
  const std::string seq = (folder / "seq").string();
  const auto kitti = test::run_program(folder, "plumb-kitti2lcm",
                                       seq + " --out " + (folder / "a.lcm").string() + more);
  ASSERT_EQ(kitti.exit_code, 0) << kitti.err;
  const auto converted = test::run_program(
      folder, "plumb-convert", seq + "/image_0 --out " + (folder / "b.lcm").string() + more);
  ASSERT_EQ(converted.exit_code, 0) << converted.err;
  EXPECT_TRUE(test::read_text(folder / "a.lcm") == test::read_text(folder / "b.lcm"));
}

/// What plumb-kitti2lcm assumes when calib.txt does not say it.
constexpr const char* kKittiResidual = "residual_k1: 0.0256\nresidual_k2: -0.0076\n";

TEST(ConvertKitti, GivesTheLogOfKitti2lcm) {
  const test::TempFolder folder;
  test::write_odometry(folder, 15, 100);
  folder.write("seq/calib.txt", std::string(test::kCalibration) + kKittiResidual +
                                    "camera_height_m: 1.65\nreadout_s: 0.01\n");
  std::filesystem::remove(folder / "seq/image_0/000103.png");
  for (const char* more : {"", " --compress jpeg", " --start 102 --end 112"})
    expect_log_of_kitti2lcm(folder, more);
}

TEST(ConvertKitti, GivesTheLogOfKitti2lcmForARealDrive) {
  const auto drive = test::kitti_sequence("odometry/sequences/05_100-159");
  if (drive.empty()) GTEST_SKIP() << test::kNoKitti;
  const test::TempFolder folder;
  folder.write("seq/calib.txt", test::read_text(drive / "calib.txt") + kKittiResidual);
  folder.write("seq/times.txt", test::read_text(drive / "times.txt"));
  std::filesystem::create_directory_symlink(drive / "image_0", folder / "seq/image_0");
  expect_log_of_kitti2lcm(folder);
}

TEST(ConvertHelp, AnswersHelpAndVersion) {
  const test::TempFolder folder;
  const auto help = test::run_program(folder, "plumb-convert", "--help");
  EXPECT_EQ(help.exit_code, 0);
  expect_contains(help.out, "Examples");
  EXPECT_EQ(test::run_program(folder, "plumb-convert", "--version").exit_code, 0);
}

}  // namespace
}  // namespace plumb
