#include "modules/camera/kitti_source.hpp"

#include <gtest/gtest.h>

#include "platform/process.hpp"
#include "tests/camera/pattern.hpp"
#include "tests/support/kitti_data.hpp"
#include "tests/support/kitti_folder.hpp"

namespace plumb {
namespace {

using test::KittiFolder;

/// Plays the folder to its end. Returns the sentence of the InputError, or "" without an error.
std::string error_of(const std::string& path, int camera = 0) {
  try {
    KittiSource source(path, camera);
    GreyFrame frame;
    while (source.read(&frame)) {
    }
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_error(const std::string& path, const std::string& part) {
  const std::string error = error_of(path);
  EXPECT_NE(error.find(part), std::string::npos) << "'" << part << "' is not in: " << error;
}

// The tests of plumb-kitti2lcm cover every kind of folder and every error in one. These tests cover
// what plumb-camera does with a folder.

TEST(KittiSource, DeliversEveryPixelTimeAndNumber) {
  const KittiFolder folder;
  folder.fill(100, 4);
  KittiSource source(folder.path(), 0);
  EXPECT_EQ(source.num_frames(), 4U);
  GreyFrame frame;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(source.read(&frame));
    EXPECT_EQ(frame.seq, 100 + i);
    EXPECT_EQ(frame.capture_us, kOdometryEpoch_us + 10'000'000 + 100'000 * i);
    test::expect_pixels(frame.image, KittiFolder::image(100 + i));
  }
  EXPECT_FALSE(source.read(&frame));
  EXPECT_FALSE(source.read(&frame));
}

TEST(KittiSource, AMissingFileIsAGapInSeqAndKeepsTheTimesInPlace) {
  const KittiFolder folder;
  folder.fill(7, 4);
  std::filesystem::remove(folder.file(9));
  KittiSource source(folder.path(), 0);
  GreyFrame frame;
  std::vector<std::pair<std::int64_t, std::int64_t>> steps;
  while (source.read(&frame)) steps.emplace_back(frame.seq, frame.capture_us - kOdometryEpoch_us);
  EXPECT_EQ(steps, (decltype(steps){{7, 700'000}, {8, 800'000}, {10, 1'000'000}}));
}

TEST(KittiSource, RefusesAFolderWithoutImages) {
  expect_error("/nowhere/at/all", "/nowhere/at/all is not a folder");
  const KittiFolder folder;
  expect_error(folder.path(), "has neither image_0 nor");
  folder.write("image_0/readme.md", "none");
  expect_error(folder.path(), "image_0");
}

TEST(KittiSource, RefusesTimesThatAreMissingUnreadableOrRunBackwards) {
  const KittiFolder folder;
  folder.fill(0, 3);
  folder.write("times.txt", "0.0\n0.1\n");
  expect_error(folder.path(), "times.txt has 2 rows for 3 images");
  folder.write("times.txt", "0.0\nzero\n0.2\n");
  expect_error(folder.path(), "times.txt:2");
  folder.write("times.txt", "0.0\n0.2\n0.1\n");
  expect_error(folder.path(), "the time of frame 2 lies before that of frame 1");
  folder.write("times.txt", "0.0\n0.1\n0.1\n");
  expect_error(folder.path(), "the time of frame 2 is the same as that of frame 1");
  std::filesystem::remove(folder.path() + "/times.txt");
  expect_error(folder.path(), "times.txt");
}

TEST(KittiSource, RefusesACalibrationThatIsMissingOrNotNumeric) {
  const KittiFolder folder;
  folder.fill(0, 2);
  folder.write("calib.txt", "P1: 1 0 1 0 0 1 1 0 0 0 1 0\n");
  expect_error(folder.path(), "calib.txt");
  folder.write("calib.txt", "P0: 80 0 47 0 0 eighty 31 0 0 0 1 0\n");
  expect_error(folder.path(), "calib.txt:1");
  std::filesystem::remove(folder.path() + "/calib.txt");
  expect_error(folder.path(), "calib.txt");
}

TEST(KittiSource, RefusesAnImageOfAnotherSizeByItsName) {
  const KittiFolder folder;
  folder.fill(0, 3);
  folder.write_image(2, test::noise(KittiFolder::kHeight, KittiFolder::kWidth - 1, 1));
  expect_error(folder.path(), folder.file(2) + " is 95x64, the images before it are 96x64");
}

TEST(KittiSource, RefusesSixteenBitColourAndDamagedImages) {
  const KittiFolder folder;
  folder.fill(0, 3);
  const cv::Size size(KittiFolder::kWidth, KittiFolder::kHeight);
  folder.write_image(1, cv::Mat(size, CV_16U, cv::Scalar(700)));
  expect_error(folder.path(), folder.file(1) + " has 16 bits per channel");
  folder.write_image(1, cv::Mat(size, CV_8UC3, cv::Scalar(1, 2, 3)));
  expect_error(folder.path(), folder.file(1) + " is a colour image");
  folder.write_image(1);
  std::filesystem::resize_file(folder.file(1), std::filesystem::file_size(folder.file(1)) / 2);
  expect_error(folder.path(), folder.file(1) + " is cut off");
  folder.write("image_0/000001.png", "no PNG at all");
  expect_error(folder.path(), folder.file(1) + " is not a PNG image");
}

TEST(KittiSource, ColourCamerasBecomeGreyWithTheirOwnCalibration) {
  const KittiFolder folder;
  folder.fill(0, 2);
  std::filesystem::rename(folder.path() + "/image_0", folder.path() + "/image_2");
  cv::Mat colour(KittiFolder::kHeight, KittiFolder::kWidth, CV_8UC3, cv::Scalar(10, 100, 200));
  cv::imwrite(folder.path() + "/image_2/000000.png", colour);
  KittiSource source(folder.path(), 2);
  GreyFrame frame;
  ASSERT_TRUE(source.read(&frame));
  EXPECT_NEAR(frame.image.at(5, 5), 0.114 * 10 + 0.587 * 100 + 0.299 * 200, 1.0);
  CameraConfig config;
  source.complete(&config);
  EXPECT_EQ(config.fx_px, 90.5);
}

TEST(KittiSource, FillsTheCalibrationAndKeepsTheRig) {
  const KittiFolder folder;
  folder.fill(0, 2);
  CameraConfig config;
  config.camera_height_m = 1.65;
  KittiSource(folder.path(), 0).complete(&config);
  EXPECT_EQ(config.width_px, 96);
  EXPECT_EQ(config.height_px, 64);
  EXPECT_EQ(config.fx_px, 80.5);
  EXPECT_EQ(config.fy_px, 81.5);
  EXPECT_EQ(config.cx_px, 47.25);
  EXPECT_EQ(config.cy_px, 31.75);
  EXPECT_EQ(config.camera_height_m, 1.65);
  EXPECT_EQ(config.residual_k1, kKittiResidualK1);
  EXPECT_EQ(config.residual_k2, kKittiResidualK2);
  CameraConfig own;
  own.residual_k1 = -0.002;
  KittiSource(folder.path(), 0).complete(&own);
  EXPECT_EQ(own.residual_k1, -0.002);
  EXPECT_EQ(own.residual_k2, 0.0);
}

TEST(KittiSource, RefusesAConfigurationThatContradictsTheFolder) {
  const KittiFolder folder;
  folder.fill(0, 2);
  const KittiSource source(folder.path(), 0);
  CameraConfig size;
  size.width_px = 97;
  EXPECT_THROW(source.complete(&size), UsageError);
  CameraConfig focal;
  focal.fx_px = 80.0;
  EXPECT_THROW(source.complete(&focal), UsageError);
  CameraConfig lens;
  lens.k1 = -0.3;
  EXPECT_THROW(source.complete(&lens), UsageError);
}

TEST(KittiSourceOnRealDrives, ReadsWhatIsThere) {
  const auto folder = test::kitti_sequence("odometry/sequences/05_100-159");
  if (folder.empty()) GTEST_SKIP() << test::kNoKitti;
  KittiSource source(folder, 0);
  EXPECT_EQ(source.num_frames(), 60U);
  CameraConfig config;
  source.complete(&config);
  EXPECT_EQ(config.width_px, 1226);
  EXPECT_EQ(config.height_px, 370);
  EXPECT_NEAR(config.fx_px, 707.0912, 1e-9);
  GreyFrame frame;
  ASSERT_TRUE(source.read(&frame));
  EXPECT_EQ(frame.seq, 100);
  EXPECT_EQ(frame.capture_us, kOdometryEpoch_us + 10'419'890);
}

}  // namespace
}  // namespace plumb
