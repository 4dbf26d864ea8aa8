#include "modules/camera/video_source.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "platform/process.hpp"
#include "tests/camera/pattern.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 96;

/// Writes smooth images, which the codec preserves, as MJPEG in AVI with OpenCV.
std::string write_video(const test::TempFolder& folder, int num_frames) {
  const std::string path = (folder / "drive.avi").string();
  cv::VideoWriter writer(path, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                         20.0, cv::Size(kWidth, kHeight));
  for (int i = 0; i < num_frames; ++i) {
    cv::Mat colour;
    cv::cvtColor(cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(40 + 10 * i)), colour,
                 cv::COLOR_GRAY2BGR);
    writer.write(colour);
  }
  return path;
}

TEST(VideoSource, DeliversGreyFramesAtTheFilesPace) {
  const test::TempFolder folder;
  VideoSource source(write_video(folder, 8));
  EXPECT_EQ(source.num_frames(), 8);
  GreyFrame frame;
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(source.read(&frame)) << i;
    EXPECT_EQ(frame.seq, i);
    EXPECT_NEAR(static_cast<double>(frame.capture_us), 50'000.0 * i, 1'000.0);
    EXPECT_EQ(frame.image.width_px, kWidth);
    EXPECT_EQ(frame.image.height_px, kHeight);
    EXPECT_NEAR(frame.image.at(80, 48), 40 + 10 * i, 3);
  }
  EXPECT_FALSE(source.read(&frame));
}

TEST(VideoSource, TellsTheSizeAndRefusesAnother) {
  const test::TempFolder folder;
  const VideoSource source(write_video(folder, 2));
  CameraConfig config;
  source.complete(&config);
  EXPECT_EQ(config.width_px, kWidth);
  EXPECT_EQ(config.height_px, kHeight);
  config.height_px = kHeight + 2;
  EXPECT_THROW(source.complete(&config), UsageError);
}

TEST(VideoSource, RefusesWhatIsNoVideo) {
  const test::TempFolder folder;
  EXPECT_THROW(VideoSource("/nowhere.avi"), UsageError);
  EXPECT_THROW(VideoSource(folder.path().string()), UsageError);
  EXPECT_THROW(VideoSource(folder.write("text.avi", "this is text").string()), UsageError);
  EXPECT_THROW(VideoSource(folder.write("empty.mp4", "").string()), UsageError);
}

}  // namespace
}  // namespace plumb
