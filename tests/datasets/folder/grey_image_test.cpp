#include "modules/datasets/folder/grey_image.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/expect_throw.hpp"
#include "tests/support/kitti_folder.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

/// Grey levels that change slowly, so that JPEG keeps them.
cv::Mat smooth_image() {
  cv::Mat image(72, 96, CV_8U);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u)
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(40 + u + v);
  return image;
}

std::string encoded(const char* extension, const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, image, bytes);
  return {bytes.begin(), bytes.end()};
}

/// A segment of a JPEG: marker, length, content.
std::string segment(char marker, const std::string& content) {
  const std::size_t length = content.size() + 2;
  return std::string("\xFF") + marker + static_cast<char>(length >> 8U) +
         static_cast<char>(length & 0xFFU) + content;
}

class GreyImage : public ::testing::Test {
 protected:
  [[nodiscard]] cv::Mat load(const std::string& name, const std::string& bytes) const {
    return load_grey_image(folder_.write(name, bytes));
  }
  [[nodiscard]] std::string error(const std::string& name, const std::string& bytes) const {
    return input_error_of([&] { (void)load(name, bytes); });
  }
  test::TempFolder folder_;
};

TEST_F(GreyImage, ReadsEveryFormatInGreyAndColour) {
  const cv::Mat grey = smooth_image();
  cv::Mat colour;
  cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
  for (const char* extension : {".png", ".bmp", ".pgm", ".tif", ".jpg", ".webp"}) {
    const double most =
        extension == std::string(".jpg") || extension == std::string(".webp") ? 4 : 1;
    EXPECT_LE(cv::norm(load("a", encoded(extension, grey)), grey, cv::NORM_INF), most) << extension;
    if (extension == std::string(".pgm")) continue;
    EXPECT_LE(cv::norm(load("a", encoded(extension, colour)), grey, cv::NORM_INF), most)
        << extension;
  }
}

TEST_F(GreyImage, WeighsColoursAsLuma) {
  const cv::Mat orange(72, 96, CV_8UC3, cv::Scalar(10, 100, 200));
  for (const char* extension : {".png", ".jpg", ".ppm"})
    EXPECT_NEAR(load("a", encoded(extension, orange)).at<std::uint8_t>(30, 40), 119.6, 2.0);
}

TEST_F(GreyImage, TurnsAnImageAsItsExifDataSay) {
  // One entry: tag 0x0112 (orientation), of type 3 (short), is 6 (to be turned by 90 degrees).
  const std::string exif("Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0",
                         32);
  std::string jpeg = encoded(".jpg", smooth_image());
  jpeg.insert(2, segment('\xE1', exif));
  EXPECT_EQ(load("a.jpg", jpeg).size(), cv::Size(72, 96));
}

TEST_F(GreyImage, RefusesAJpegThatIsCutOffAnywhere) {
  const std::string whole = encoded(".jpg", smooth_image());
  for (std::size_t size = 0; size < whole.size(); size += 13)
    EXPECT_NE(error("a.jpg", whole.substr(0, size)), "") << size;
  expect_contains(error("a.jpg", whole.substr(0, whole.size() - 2)), "a.jpg is cut off");
}

TEST_F(GreyImage, TheEndOfAPreviewIsNotTheEndOfTheJpeg) {
  const std::string jpeg = encoded(".jpg", smooth_image());
  std::string whole = jpeg;
  whole.insert(2, segment('\xE1', jpeg));
  EXPECT_EQ(error("a.jpg", whole), "");
  EXPECT_EQ(error("a.jpg", whole + "what a camera writes behind the image"), "");
  expect_contains(error("a.jpg", whole.substr(0, whole.size() - 20)), "a.jpg is cut off");
}

TEST_F(GreyImage, RefusesOtherFormatsThatAreCutOff) {
  for (const char* extension : {".png", ".bmp", ".pgm", ".tif", ".webp"}) {
    const std::string whole = encoded(extension, smooth_image());
    EXPECT_NE(error("a", whole.substr(0, whole.size() / 2)), "") << extension;
  }
}

TEST_F(GreyImage, RefusesMoreThanEightBits) {
  cv::Mat deep;
  smooth_image().convertTo(deep, CV_16U, 256.0);
  expect_contains(error("a.png", encoded(".png", deep)), "a.png has 16 bits per channel");
  expect_contains(error("a.tif", encoded(".tif", deep)), "a.tif has more than 8 bits per channel");
  expect_contains(error("a.pgm", encoded(".pgm", deep)), "a.pgm has more than 8 bits per channel");
}

TEST_F(GreyImage, RefusesWhatIsNoImage) {
  expect_contains(error("a.jpg", ""), "a.jpg is empty");
  expect_contains(error("a.jpg", "this is text"), "a.jpg is not an image that can be read");
  expect_contains(input_error_of([&] { (void)load_grey_image(folder_ / "none.jpg"); }), "none.jpg");
  expect_contains(input_error_of([&] { (void)load_grey_image(folder_.path()); }), "cannot read");
}

}  // namespace
}  // namespace plumb
