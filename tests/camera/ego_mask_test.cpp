#include "modules/camera/ego_mask.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "tests/camera/pattern.hpp"

namespace plumb {
namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 120;

TEST(EgoMask, PolygonCoversTheSamePixelsAsOpenCvButForItsOutline) {
  MaskPainter painter(kWidth, kHeight);
  ASSERT_TRUE(painter.add_polygon("20,119.5 60,70 140,72  180,119.5"));
  cv::Mat filled(kHeight, kWidth, CV_8U, cv::Scalar(0));
  const std::vector<cv::Point> corners{{20, 120}, {60, 70}, {140, 72}, {180, 120}};
  cv::fillPoly(filled, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(1));
  // fillPoly also draws the outline, so only pixels off the outline are compared.
  cv::Mat inner;
  cv::Mat outer;
  cv::erode(filled, inner, cv::Mat::ones(5, 5, CV_8U), {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::dilate(filled, outer, cv::Mat::ones(5, 5, CV_8U));
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const int covered = painter.covered()[static_cast<std::size_t>(v * kWidth + u)];
      if (inner.at<std::uint8_t>(v, u) != 0) {
        EXPECT_EQ(covered, 1) << u << "," << v;
      }
      if (outer.at<std::uint8_t>(v, u) == 0) {
        EXPECT_EQ(covered, 0) << u << "," << v;
      }
    }
  }
}

TEST(EgoMask, RefusesTextThatIsNoPolygon) {
  for (const char* text : {"", "1,2 3,4", "1,2 3,4 5", "1,2 3,4 5,x", "1,2 3,4 5,6,7",
                           "1;2 3;4 5;6", "nan,1 2,3 4,5", "1,2,3,4,5,6", "1, 2 3, 4 5, 6"}) {
    EXPECT_FALSE(MaskPainter(10, 10).add_polygon(text)) << text;
  }
  EXPECT_TRUE(MaskPainter(10, 10).add_polygon("-5,-5 1e1,2.5 3,20"));
}

TEST(EgoMask, RowsAndBytesAddUp) {
  MaskPainter painter(kWidth, kHeight);
  painter.add_rows(10, 20);
  EXPECT_NEAR(painter.covered_ratio(), 30.0 / kHeight, 1e-12);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(kWidth * kHeight), 0);
  std::fill_n(bytes.begin() + 50 * kWidth, kWidth, std::uint8_t{255});
  painter.add_bytes(bytes.data());
  EXPECT_NEAR(painter.covered_ratio(), 31.0 / kHeight, 1e-12);
  EXPECT_EQ(painter.covered().front(), 1);
  EXPECT_EQ(painter.covered().back(), 1);
}

TEST(EgoMask, MoreRowsThanTheImageHasCoverItAll) {
  MaskPainter painter(kWidth, kHeight);
  painter.add_rows(kHeight + 5, 0);
  EXPECT_EQ(painter.covered_ratio(), 1.0);
}

TEST(EgoMask, CoveredPixelsAreFlatAndPixelsBeyondTheBlendAreUntouched) {
  constexpr int kFeather = 8;
  MaskPainter painter(kWidth, kHeight);
  painter.add_rows(0, 30);
  const EgoMask mask(painter, kFeather);
  const cv::Mat before = test::noise(kHeight, kWidth, 6);
  cv::Mat after = before.clone();
  mask.apply(after.data);
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(after.rowRange(kHeight - 30, kHeight), &low, &high);
  EXPECT_EQ(low, high);
  const int first_blended = kHeight - 30 - kFeather;
  EXPECT_EQ(
      cv::norm(after.rowRange(0, first_blended), before.rowRange(0, first_blended), cv::NORM_INF),
      0.0);
  EXPECT_GT(cv::norm(after.rowRange(first_blended, kHeight - 30),
                     before.rowRange(first_blended, kHeight - 30), cv::NORM_INF),
            0.0);
}

TEST(EgoMask, FillIsTheGreyOfTheBandAroundIt) {
  MaskPainter painter(kWidth, kHeight);
  painter.add_rows(0, 30);
  cv::Mat image(kHeight, kWidth, CV_8U, cv::Scalar(77));
  image.rowRange(kHeight - 30, kHeight).setTo(255);
  EgoMask(painter, 8).apply(image.data);
  EXPECT_EQ(cv::norm(image, cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(77)), cv::NORM_INF), 0.0);
}

/// Strongest corner along the border of the mask: the smaller eigenvalue over 7x7 pixels, by which
/// trackers rank corners.
double strongest_corner(const cv::Mat& image) {
  cv::Mat strength;
  cv::cornerMinEigenVal(image, strength, 7);
  double high = 0.0;
  cv::minMaxLoc(strength, nullptr, &high);
  return high;
}

TEST(EgoMask, ItsOwnBorderMakesNoCornerToTrack) {
  // A bright bonnet with a corner on a smooth road. A sharp black mask would leave a strong corner.
  cv::Mat road(kHeight, kWidth, CV_8U);
  for (int v = 0; v < kHeight; ++v) road.row(v).setTo(90 + v / 6);
  const char* const bonnet = "60,119.5 60,80 140,80 140,119.5";
  MaskPainter painter(kWidth, kHeight);
  ASSERT_TRUE(painter.add_polygon(bonnet));

  cv::Mat hard = road.clone();
  cv::rectangle(hard, {60, 80}, {140, kHeight - 1}, cv::Scalar(0), cv::FILLED);
  cv::Mat soft = road.clone();
  cv::rectangle(soft, {61, 81}, {139, kHeight - 1}, cv::Scalar(250), cv::FILLED);
  EgoMask(painter, 8).apply(soft.data);
  EXPECT_LT(strongest_corner(soft), 0.01 * strongest_corner(hard));
}

TEST(EgoMask, WithoutCoveredPixelsNothingChanges) {
  const EgoMask mask(MaskPainter(kWidth, kHeight), 8);
  EXPECT_TRUE(mask.empty());
  const cv::Mat before = test::noise(kHeight, kWidth, 7);
  cv::Mat after = before.clone();
  mask.apply(after.data);
  EXPECT_EQ(cv::norm(after, before, cv::NORM_INF), 0.0);
}

TEST(EgoMask, WholeImageCoveredBecomesMidGrey) {
  MaskPainter painter(kWidth, kHeight);
  painter.add_rows(kHeight, 0);
  cv::Mat image = test::noise(kHeight, kWidth, 8);
  EgoMask(painter, 8).apply(image.data);
  EXPECT_EQ(cv::norm(image, cv::Mat(kHeight, kWidth, CV_8U, cv::Scalar(128)), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace plumb
