#include "modules/datasets/kitti/png_image.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/expect_throw.hpp"
#include "tests/support/kitti_folder.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;
using test::test_image;
using test::write_image;

TEST(PngImage, GivesGreyPixelsAsTheyAre) {
  const test::TempFolder folder;
  write_image(folder, "a.png", test_image(3));
  const cv::Mat image = load_grey_png(folder / "a.png", false);
  EXPECT_EQ(cv::norm(image, test_image(3), cv::NORM_INF), 0.0);
}

TEST(PngImage, ConvertsColourOnlyWhenAllowed) {
  const test::TempFolder folder;
  cv::Mat colour;
  cv::cvtColor(test_image(3), colour, cv::COLOR_GRAY2BGR);
  write_image(folder, "a.png", colour);
  expect_contains(input_error_of([&] { (void)load_grey_png(folder / "a.png", false); }),
                  "is a colour image; --camera 2");
  EXPECT_LE(cv::norm(load_grey_png(folder / "a.png", true), test_image(3), cv::NORM_INF), 1.0);
}

TEST(PngImage, RefusesSixteenBits) {
  const test::TempFolder folder;
  cv::Mat deep;
  test_image(3).convertTo(deep, CV_16U, 256.0);
  write_image(folder, "a.png", deep);
  for (const bool colour_allowed : {false, true}) {
    expect_contains(input_error_of([&] { (void)load_grey_png(folder / "a.png", colour_allowed); }),
                    "has 16 bits per channel, expected 8");
  }
}

TEST(PngImage, RefusesAFileThatIsCutOffAnywhere) {
  const test::TempFolder folder;
  write_image(folder, "a.png", test_image(3));
  const std::string whole = test::read_text(folder / "a.png");
  for (std::size_t size = 0; size < whole.size(); size += 13) {
    folder.write("cut.png", whole.substr(0, size));
    EXPECT_NE(input_error_of([&] { (void)load_grey_png(folder / "cut.png", false); }), "") << size;
  }
  expect_contains(input_error_of([&] {
                    folder.write("cut.png", whole.substr(0, whole.size() / 2));
                    (void)load_grey_png(folder / "cut.png", false);
                  }),
                  "cut.png is cut off");
}

TEST(PngImage, RefusesCorruptPixelsAndOtherFiles) {
  const test::TempFolder folder;
  write_image(folder, "a.png", test_image(3));
  std::string bytes = test::read_text(folder / "a.png");
  for (std::size_t i = bytes.find("IDAT") + 4; i < bytes.size() - 20; ++i) bytes[i] = '\x55';
  folder.write("bad.png", bytes);
  expect_contains(input_error_of([&] { (void)load_grey_png(folder / "bad.png", false); }),
                  "is corrupt");
  folder.write("text.png", "this is text");
  expect_contains(input_error_of([&] { (void)load_grey_png(folder / "text.png", false); }),
                  "is not a PNG image");
  expect_contains(input_error_of([&] { (void)load_grey_png(folder / "none.png", false); }),
                  "none.png");
}

}  // namespace
}  // namespace plumb
