/// Tests the parts of V4L2 that need no device. vivid/run tests the rest with a virtual one.
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "modules/camera/device_source.hpp"
#include "platform/process.hpp"
#include "platform/v4l2.hpp"
#include "tests/camera/pattern.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

std::string refusal_of(const std::string& device) {
  V4l2Camera camera;
  V4l2Request request;
  request.device = device;
  request.fourccs = {"GREY"};
  EXPECT_FALSE(camera.open(request));
  EXPECT_FALSE(camera.is_open());
  return camera.why();
}

TEST(V4l2Camera, SaysWhyADeviceCannotBeOpened) {
  EXPECT_EQ(refusal_of("/nowhere/video0"),
            "/nowhere/video0: cannot be opened: No such file or directory");
  EXPECT_EQ(refusal_of("/dev/null"), "/dev/null: is not a V4L2 device");
  const test::TempFolder folder;
  const std::string file = folder.write("video0", "").string();
  EXPECT_EQ(refusal_of(file), file + ": is not a V4L2 device");
}

TEST(V4l2Camera, KeepsItsDescriptorOverFailedAttempts) {
  V4l2Camera camera;
  const int fd = camera.fileno();
  EXPECT_GE(fd, 0);
  V4l2Request request;
  request.device = "/dev/null";
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(camera.open(request));
  EXPECT_EQ(camera.fileno(), fd);
}

TEST(DeviceSource, RefusesAtStartAndReportsLater) {
  CameraConfig config;
  DeviceSource source(config, "/nowhere/video0");
  EXPECT_THROW(source.open_first(&config), UsageError);
  EXPECT_FALSE(source.reopen());
  EXPECT_NE(source.why().find("No such file"), std::string::npos);
}

/// MJPEG frames as cameras send them. vivid offers no MJPEG, so the decoder of DeviceSource is
/// tested separately.
class Mjpeg : public testing::Test {
 protected:
  static constexpr int kWidth = 320;
  static constexpr int kHeight = 184;
  const char* decode(const std::vector<std::uint8_t>& jpeg) {
    ImageFrame frame;
    frame.width_px = kWidth;
    frame.height_px = kHeight;
    frame.compressed = true;
    frame.data = jpeg;
    return decoder_.decode(frame, &view_);
  }
  cv::Mat image_ = test::waves(kWidth, kHeight);
  std::vector<std::uint8_t> jpeg_ = encoded(image_);
  ImageDecoder decoder_{kWidth, kHeight};
  ImageView view_;

  static std::vector<std::uint8_t> encoded(const cv::Mat& image) {
    cv::Mat colour;  // cameras send YCbCr 4:2:0 or 4:2:2
    cv::cvtColor(image, colour, cv::COLOR_GRAY2BGR);
    std::vector<std::uint8_t> jpeg;
    cv::imencode(".jpg", colour, jpeg, {cv::IMWRITE_JPEG_QUALITY, 95});
    return jpeg;
  }
  [[nodiscard]] double mean_difference() const {
    const cv::Mat decoded(kHeight, kWidth, CV_8U, const_cast<std::uint8_t*>(view_.data),
                          static_cast<std::size_t>(view_.stride_bytes));
    cv::Mat difference;
    cv::absdiff(decoded, image_, difference);
    return cv::mean(difference)[0];
  }
};

TEST_F(Mjpeg, DecodesToTheGreyThatWasEncoded) {
  ASSERT_EQ(decode(jpeg_), nullptr);
  EXPECT_LT(mean_difference(), 1.0);
}

TEST_F(Mjpeg, TheBufferMayBePaddedWithZeros) {
  jpeg_.resize(jpeg_.size() + 5000, 0);
  ASSERT_EQ(decode(jpeg_), nullptr);
  EXPECT_LT(mean_difference(), 1.0);
}

TEST_F(Mjpeg, HuffmanTablesMayBeLeftOutAsUvcCamerasDo) {
  std::vector<std::uint8_t> bare;
  for (std::size_t at = 0; at < jpeg_.size();) {
    const bool is_table = at + 4 < jpeg_.size() && jpeg_[at] == 0xFF && jpeg_[at + 1] == 0xC4;
    if (is_table) {
      at += 2 + static_cast<std::size_t>(jpeg_[at + 2] << 8 | jpeg_[at + 3]);
    } else {
      bare.push_back(jpeg_[at++]);
    }
  }
  ASSERT_LT(bare.size() + 100, jpeg_.size());
  ASSERT_EQ(decode(bare), nullptr);
  EXPECT_LT(mean_difference(), 1.0);
}

TEST_F(Mjpeg, ACutOrForeignBufferIsRefused) {
  std::vector<std::uint8_t> cut(jpeg_.begin(),
                                jpeg_.begin() + static_cast<std::ptrdiff_t>(jpeg_.size() / 2));
  EXPECT_NE(decode(cut), nullptr);
  EXPECT_NE(decode({}), nullptr);
  EXPECT_NE(decode(std::vector<std::uint8_t>(4000, 0)), nullptr);
  EXPECT_NE(decode(encoded(test::waves(kWidth / 2, kHeight))), nullptr);
}

}  // namespace
}  // namespace plumb
