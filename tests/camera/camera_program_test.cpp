/// Tests plumb-camera as a real process with real LCM in a private network.
#include <gtest/gtest.h>

#include <csignal>

#include "modules/camera/image_wire.hpp"
#include "platform/bus.hpp"
#include "platform/clock.hpp"
#include "plumb/process_health_t.hpp"
#include "tests/camera/pattern.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/kitti_folder.hpp"
#include "tests/support/private_network.hpp"

namespace plumb {
namespace {

using test::ChildProcess;
using test::KittiFolder;

struct Received {
  std::int64_t capture_us;
  std::int64_t seq;
  std::int64_t arrival_us;
  cv::Mat image;
};

/// Everything that a run of plumb-camera published.
struct Published {
  std::vector<Received> images;
  std::vector<std::size_t> calibrations_at;  ///< number of images before each calibration
  camera_calibration_t calibration{};
  std::vector<process_health_t> health;
  int exit_code = -1;
  std::string output;

  [[nodiscard]] bool said(const std::string& reason) const {
    return std::any_of(health.begin(), health.end(), [&](const auto& h) {
      return h.state_reason.find(reason) != std::string::npos;
    });
  }
};

const char* take_image(RawSubscriber::Bytes bytes, Published* run) {
  ImageFrame frame;
  if (const char* why = read_image(bytes, &frame)) return why;
  const cv::Mat borrowed(frame.height_px, frame.width_px, CV_8U,
                         const_cast<std::uint8_t*>(frame.data.data()),
                         static_cast<std::size_t>(frame.row_stride_bytes));
  run->images.push_back({frame.capture_us, frame.seq, monotonic_us(), borrowed.clone()});
  return nullptr;
}

Published run_camera(std::vector<std::string> arguments) {
  Published run;
  Counters counters;
  Bus bus("", &counters);
  RawSubscriber images(bus, kCamera, Input::kPeriodic,
                       [&](auto bytes) { return take_image(bytes, &run); });
  Subscriber<camera_calibration_t> calibrations(bus, kCameraCalibration, Input::kOccasional,
                                                [&](const auto& message) {
                                                  run.calibrations_at.push_back(run.images.size());
                                                  run.calibration = message;
                                                  return nullptr;
                                                });
  Subscriber<process_health_t> health(bus, kHealthCamera, Input::kPeriodic,
                                      [&](const auto& message) {
                                        run.health.push_back(message);
                                        return nullptr;
                                      });
  arguments.insert(arguments.begin(), "plumb-camera");
  ChildProcess child(arguments);
  const std::int64_t end_us = monotonic_us() + 30'000'000;
  while (run.exit_code < 0 && monotonic_us() < end_us) {
    bus.handle(20);
    run.exit_code = child.wait(0.0);
    if (run.exit_code < 0) run.exit_code = child.wait(0.001);
  }
  while (bus.handle(200)) {
  }
  run.output = child.output();
  EXPECT_EQ(counters.num_rejected, 0) << counters.last_rejection;
  return run;
}

class PlumbCamera : public testing::Test {
 protected:
  static void SetUpTestSuite() { private_ = test::enter_private_network(); }
  void SetUp() override {
    if (!private_) GTEST_SKIP() << test::kNoPrivateNetwork;
  }
  static inline bool private_ = false;
};

TEST_F(PlumbCamera, PlaysAKittiFolderAtItsPaceTimesSpeed) {
  const KittiFolder folder;
  folder.fill(100, 25);
  const Published run = run_camera({"--kitti", folder.path(), "--speed", "2"});
  EXPECT_EQ(run.exit_code, 0) << run.output;
  ASSERT_EQ(run.images.size(), 25U);
  for (std::size_t i = 0; i < run.images.size(); ++i) {
    EXPECT_EQ(run.images[i].seq, 100 + static_cast<std::int64_t>(i));
    EXPECT_EQ(run.images[i].capture_us - run.images[0].capture_us,
              100'000 * static_cast<std::int64_t>(i));
    const cv::Mat sent = KittiFolder::image(100 + static_cast<int>(i));
    EXPECT_EQ(cv::norm(sent, run.images[i].image, cv::NORM_INF), 0.0);
  }
  // There are 24 steps of 50 ms. Under load a frame may be late,
  // but never early, and the player catches up.
  const auto span_us = run.images.back().arrival_us - run.images.front().arrival_us;
  EXPECT_GT(span_us, 1'100'000);
  EXPECT_LT(span_us, 2'200'000);
}

TEST_F(PlumbCamera, CalibrationComesFirstAndThenOnceASecond) {
  const KittiFolder folder;
  folder.fill(0, 25);
  const Published run = run_camera({"--kitti", folder.path(), "--speed", "0"});
  EXPECT_EQ(run.calibrations_at, (std::vector<std::size_t>{0, 10, 20}));
  EXPECT_EQ(run.calibration.width, KittiFolder::kWidth);
  EXPECT_EQ(run.calibration.height, KittiFolder::kHeight);
  EXPECT_EQ(run.calibration.fx_px, 80.5);
  EXPECT_EQ(run.calibration.cy_px, 31.75);
}

TEST_F(PlumbCamera, AFrozenFolderIsReportedAndStillPublished) {
  const KittiFolder folder;
  folder.fill(0, 15);
  for (int i = 0; i < 15; ++i)
    folder.write_image(i, test::waves(KittiFolder::kWidth, KittiFolder::kHeight));
  const Published run = run_camera({"--kitti", folder.path()});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.images.size(), 15U);
  EXPECT_TRUE(run.said("the image is frozen"));
}

TEST_F(PlumbCamera, ABlackFolderIsReported) {
  const KittiFolder folder;
  folder.fill(0, 15);
  for (int i = 0; i < 15; ++i) {
    folder.write_image(
        i, cv::Mat(KittiFolder::kHeight, KittiFolder::kWidth, CV_8U, cv::Scalar(i % 2)));
  }
  EXPECT_TRUE(run_camera({"--kitti", folder.path()}).said("the image is black"));
}

TEST_F(PlumbCamera, MissingFilesAreCounted) {
  const KittiFolder folder;
  folder.fill(0, 20);
  for (const int i : {3, 4, 11}) std::filesystem::remove(folder.file(i));
  const Published run = run_camera({"--kitti", folder.path()});
  ASSERT_GE(run.health.size(), 2U);
  EXPECT_EQ(run.health[run.health.size() - 2].num_dropped, 3);
  EXPECT_NE(run.output.find("lost 3"), std::string::npos) << run.output;
}

TEST_F(PlumbCamera, AWrongImageInTheMiddleEndsTheRunWithItsName) {
  const KittiFolder folder;
  folder.fill(0, 6);
  folder.write_image(3, test::noise(KittiFolder::kHeight + 1, KittiFolder::kWidth, 1));
  const Published run = run_camera({"--kitti", folder.path(), "--speed", "0"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.images.size(), 3U);
  EXPECT_NE(run.output.find(folder.file(3) + " is 96x65"), std::string::npos) << run.output;
}

TEST_F(PlumbCamera, AMaskFileBesideTheConfigurationCovers) {
  const KittiFolder folder;
  folder.fill(0, 3);
  cv::Mat mask(KittiFolder::kHeight, KittiFolder::kWidth, CV_8U, cv::Scalar(0));
  mask.rowRange(44, KittiFolder::kHeight).setTo(255);
  cv::imwrite(folder.path() + "/bonnet.pgm", mask);
  folder.write("camera.toml", "[camera]\nmask_file = \"bonnet.pgm\"\ncamera_height_m = 1.65\n");
  const Published run = run_camera(
      {"--config", folder.path() + "/camera.toml", "--kitti", folder.path(), "--speed", "0"});
  EXPECT_EQ(run.exit_code, 0) << run.output;
  ASSERT_EQ(run.images.size(), 3U);
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(run.images[1].image.rowRange(44, KittiFolder::kHeight), &low, &high);
  EXPECT_EQ(low, high);
  EXPECT_EQ(run.calibration.camera_height_m, 1.65);
}

TEST_F(PlumbCamera, PlaysAFolderOfImagesAtItsRate) {
  const KittiFolder folder;
  for (const int i : {9, 10, 11, 14}) folder.write_image(i);
  folder.write("camera.toml",
               "[camera]\nfx_px = 80.5\nfy_px = 81.5\ncx_px = 47.25\ncy_px = 31.75\n");
  const Published run = run_camera({"--config", folder.path() + "/camera.toml", "--images",
                                    folder.path() + "/image_0", "--rate", "25", "--speed", "0"});
  EXPECT_EQ(run.exit_code, 0) << run.output;
  ASSERT_EQ(run.images.size(), 4U);
  EXPECT_EQ(run.images[3].seq, 14);
  EXPECT_EQ(run.images[3].capture_us - run.images[0].capture_us, 200'000);
  EXPECT_EQ(cv::norm(KittiFolder::image(14), run.images[3].image, cv::NORM_INF), 0.0);
  EXPECT_EQ(run.calibration.width, KittiFolder::kWidth);
  EXPECT_EQ(run.calibration.cy_px, 31.75);
  EXPECT_NE(run.output.find("2 images are missing before 000014.png"), std::string::npos)
      << run.output;
}

TEST_F(PlumbCamera, StopsCleanlyOnASignal) {
  const KittiFolder folder;
  folder.fill(0, 3);
  folder.write("times.txt", "0\n0.1\n1000\n");
  for (const int number : {SIGINT, SIGTERM}) {
    Counters counters;
    Bus bus("", &counters);
    bool runs = false;
    const RawSubscriber images(bus, kCamera, Input::kPeriodic, [&](auto /*bytes*/) -> const char* {
      runs = true;
      return nullptr;
    });
    ChildProcess child({"plumb-camera", "--kitti", folder.path()});
    for (int i = 0; i < 1000 && !runs; ++i) bus.handle(20);
    ASSERT_TRUE(runs) << child.output();
    child.signal(number);
    EXPECT_EQ(child.wait(), 0) << child.output();
  }
}

TEST_F(PlumbCamera, RefusesBadInputWithOneSentenceAndCode2) {
  const KittiFolder folder;
  folder.fill(0, 2);
  folder.write("mask.toml", "[camera]\nmask_file = \"none.png\"\n");
  folder.write("polygon.toml", "[camera]\nmask_polygon = \"1,2 3\"\n");
  folder.write("format.toml", "[camera]\npixel_format = \"RGB3\"\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{}, "no source"},
      {{"--kitti", "/nowhere"}, "/nowhere is not a folder"},
      {{"--video", "/nowhere.mp4"}, "cannot read /nowhere.mp4"},
      {{"--device", "/dev/null"}, "is not a V4L2 device"},
      {{"--kitti", folder.path(), "--speed", "-1"}, "--speed"},
      {{"--images", "/nowhere"}, "no image folder /nowhere"},
      {{"--images", folder.path()}, "has no image"},
      {{"--kitti", folder.path(), "--rate", "10"}, "--rate"},
      {{"--kitti", folder.path(), "--video", "x"}, "excludes"},
      {{"--kitti", folder.path(), "--images", "x"}, "excludes"},
      {{"--device", "/dev/null", "--speed", "2"}, "excludes"},
      {{"--sped", "1"}, "--sped"},
      {{"--config", folder.path() + "/mask.toml", "--kitti", folder.path()},
       "camera.mask_file: cannot read"},
      {{"--config", folder.path() + "/polygon.toml", "--kitti", folder.path()},
       "camera.mask_polygon"},
      {{"--config", folder.path() + "/format.toml", "--kitti", folder.path()},
       "format.toml:2: camera.pixel_format"},
  };
  for (const auto& [arguments, sentence] : cases) {
    std::vector<std::string> all = arguments;
    all.insert(all.begin(), "plumb-camera");
    ChildProcess child(all);
    EXPECT_EQ(child.wait(), 2) << sentence;
    EXPECT_NE(child.output().find(sentence), std::string::npos) << sentence << "\n"
                                                                << child.output();
    EXPECT_EQ(std::count(child.output().begin(), child.output().end(), '\n'), 1) << child.output();
  }
}

}  // namespace
}  // namespace plumb
