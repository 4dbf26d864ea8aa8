#include "modules/camera/convert.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/camera/pattern.hpp"

namespace plumb {
namespace {

int count_differences(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  return cv::countNonZero(difference);
}

TEST(Convert, YuyvGivesTheSameGreyAsOpenCv) {
  const cv::Mat packed_bytes = test::noise(36, 64 * 2, 1);
  const cv::Mat packed(36, 64, CV_8UC2, packed_bytes.data);
  cv::Mat expected;
  cv::cvtColor(packed, expected, cv::COLOR_YUV2GRAY_YUY2);
  cv::Mat grey(36, 64, CV_8U);
  yuyv_to_grey(packed_bytes.data, 64, 36, 128, grey.data);
  EXPECT_EQ(count_differences(grey, expected), 0);
}

TEST(Convert, YuyvRowsMayBeLongerThanTheImage) {
  const cv::Mat padded = test::noise(20, 100, 2);
  const cv::Mat packed_bytes = padded(cv::Rect(0, 0, 60, 20)).clone();
  cv::Mat expected;
  cv::cvtColor(cv::Mat(20, 30, CV_8UC2, packed_bytes.data), expected, cv::COLOR_YUV2GRAY_YUY2);
  cv::Mat grey(20, 30, CV_8U);
  yuyv_to_grey(padded.data, 30, 20, 100, grey.data);
  EXPECT_EQ(count_differences(grey, expected), 0);
}

TEST(Convert, Nv12GivesTheSameGreyAsOpenCv) {
  const cv::Mat planes = test::noise(48 * 3 / 2, 80, 3);
  cv::Mat expected;
  cv::cvtColor(planes, expected, cv::COLOR_YUV2GRAY_NV12);
  cv::Mat grey(48, 80, CV_8U);
  copy_rows(luma_plane(PixelFormat::kNv12, planes.data, 80, 48, 80), grey.data);
  EXPECT_EQ(count_differences(grey, expected), 0);
}

TEST(Convert, GreyRowsLoseTheirPaddingAndNothingElse) {
  const cv::Mat padded = test::noise(24, 96, 4);
  cv::Mat grey(24, 70, CV_8U);
  copy_rows(luma_plane(PixelFormat::kGrey, padded.data, 70, 24, 96), grey.data);
  EXPECT_EQ(count_differences(grey, padded(cv::Rect(0, 0, 70, 24))), 0);
}

TEST(Convert, PackedFormatsHaveNoLumaPlane) {
  const std::uint8_t byte = 0;
  EXPECT_TRUE(luma_plane(PixelFormat::kYuyv, &byte, 1, 1, 1).empty());
  EXPECT_TRUE(luma_plane(PixelFormat::kMjpeg, &byte, 1, 1, 1).empty());
}

TEST(Convert, BufferSizesFollowTheFormat) {
  EXPECT_EQ(required_stride(PixelFormat::kGrey, 321), 321U);
  EXPECT_EQ(required_stride(PixelFormat::kYuyv, 321), 644U);
  EXPECT_EQ(required_stride(PixelFormat::kNv12, 321), 321U);
  EXPECT_EQ(required_bytes(PixelFormat::kGrey, 181, 336), 181U * 336U);
  EXPECT_EQ(required_bytes(PixelFormat::kYuyv, 181, 644), 181U * 644U);
  EXPECT_EQ(required_bytes(PixelFormat::kNv12, 181, 336), (181U + 91U) * 336U);
  EXPECT_EQ(required_bytes(PixelFormat::kMjpeg, 181, 336), 0U);
}

}  // namespace
}  // namespace plumb
