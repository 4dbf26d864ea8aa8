#include "modules/camera/rectify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/camera/pattern.hpp"

namespace plumb {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 360;
constexpr PinholePx kCaptured{420.0, 422.0, 317.3, 181.9};

cv::Matx33d matrix_of(const PinholePx& p) {
  return {p.fx_px, 0.0, p.cx_px, 0.0, p.fy_px, p.cy_px, 0.0, 0.0, 1.0};
}

struct Comparison {
  double mean = 0.0;
  double max = 0.0;
  int num_pixels = 0;
};

/// Difference in grey levels between our result and OpenCV's, where both are valid.
Comparison compare(const Rectifier& rectifier, const cv::Mat& ours, const cv::Mat& theirs) {
  Comparison result;
  for (int v = 0; v < ours.rows; ++v) {
    for (int u = 0; u < ours.cols; ++u) {
      if (rectifier.unseen()[static_cast<std::size_t>(v * ours.cols + u)] != 0) continue;
      const double d = std::abs(ours.at<std::uint8_t>(v, u) - theirs.at<float>(v, u));
      result.mean += d;
      result.max = std::max(result.max, d);
      ++result.num_pixels;
    }
  }
  result.mean /= std::max(result.num_pixels, 1);
  return result;
}

/// Samples OpenCV's map in floating point, because cv::remap on 8 bits rounds the map to 1/32 px.
cv::Mat opencv_rectified(const cv::Mat& image, const cv::Mat& map_u, const cv::Mat& map_v) {
  cv::Mat out(image.size(), CV_32F, cv::Scalar(0));
  for (int v = 0; v < out.rows; ++v) {
    for (int u = 0; u < out.cols; ++u) {
      const double x = map_u.at<float>(v, u);
      const double y = map_v.at<float>(v, u);
      const int x0 = std::clamp(static_cast<int>(std::floor(x)), 0, image.cols - 2);
      const int y0 = std::clamp(static_cast<int>(std::floor(y)), 0, image.rows - 2);
      const double a = x - x0;
      const double b = y - y0;
      const auto at = [&](int dx, int dy) -> double {
        return image.at<std::uint8_t>(y0 + dy, x0 + dx);
      };
      out.at<float>(v, u) = static_cast<float>((1 - b) * ((1 - a) * at(0, 0) + a * at(1, 0)) +
                                               b * ((1 - a) * at(0, 1) + a * at(1, 1)));
    }
  }
  return out;
}

TEST(Rectify, PlumbBobMatchesOpenCvsMapWithinOneGreyLevel) {
  const Lens lens{LensModel::kPlumbBob, -0.31, 0.12, 0.0011, -0.0007, -0.021, 0.0};
  const PinholePx published{400.0, 401.0, 320.0, 180.0};
  const Rectifier rectifier(kWidth, kHeight, kCaptured, lens, published);
  const cv::Mat image = test::waves(kWidth, kHeight);
  cv::Mat ours(image.size(), CV_8U);
  rectifier.apply(test::view_of(image), ours.data);

  cv::Mat map_u;
  cv::Mat map_v;
  cv::initUndistortRectifyMap(
      matrix_of(kCaptured), cv::Vec<double, 5>(-0.31, 0.12, 0.0011, -0.0007, -0.021), cv::noArray(),
      matrix_of(published), image.size(), CV_32F, map_u, map_v);
  const Comparison c = compare(rectifier, ours, opencv_rectified(image, map_u, map_v));
  EXPECT_GT(c.num_pixels, kWidth * kHeight * 3 / 4);
  EXPECT_LT(c.max, 0.75);   // rounding to a byte contributes 0.5
  EXPECT_LT(c.mean, 0.27);  // rounding to a byte contributes 0.25
}

TEST(Rectify, FisheyeMatchesOpenCvsMapWithinOneGreyLevel) {
  const Lens lens{LensModel::kFisheye, 0.05, -0.012, 0.0, 0.0, 0.003, -0.0004};
  const PinholePx published{300.0, 300.0, 320.0, 180.0};
  const Rectifier rectifier(kWidth, kHeight, kCaptured, lens, published);
  const cv::Mat image = test::waves(kWidth, kHeight);
  cv::Mat ours(image.size(), CV_8U);
  rectifier.apply(test::view_of(image), ours.data);

  cv::Mat map_u;
  cv::Mat map_v;
  cv::fisheye::initUndistortRectifyMap(matrix_of(kCaptured),
                                       cv::Vec4d(0.05, -0.012, 0.003, -0.0004), cv::noArray(),
                                       matrix_of(published), image.size(), CV_32F, map_u, map_v);
  const Comparison c = compare(rectifier, ours, opencv_rectified(image, map_u, map_v));
  EXPECT_GT(c.num_pixels, kWidth * kHeight / 2);
  EXPECT_LT(c.max, 0.75);
  EXPECT_LT(c.mean, 0.27);
}

TEST(Rectify, UndistortOfOpenCvAgreesWithinItsOwnRounding) {
  const Lens lens{LensModel::kPlumbBob, -0.2, 0.05, 0.0, 0.0, 0.0, 0.0};
  const Rectifier rectifier(kWidth, kHeight, kCaptured, lens, kCaptured);
  const cv::Mat image = test::waves(kWidth, kHeight);
  cv::Mat ours(image.size(), CV_8U);
  rectifier.apply(test::view_of(image), ours.data);
  cv::Mat theirs;
  cv::undistort(image, theirs, matrix_of(kCaptured), cv::Vec<double, 5>(-0.2, 0.05, 0.0, 0.0, 0.0));
  cv::Mat theirs_float;
  theirs.convertTo(theirs_float, CV_32F);
  const Comparison c = compare(rectifier, ours, theirs_float);
  EXPECT_LT(c.mean, 0.3);
  EXPECT_LE(c.max, 1.0);
}

double unseen_ratio(const Rectifier& rectifier) {
  const auto& unseen = rectifier.unseen();
  return static_cast<double>(std::count(unseen.begin(), unseen.end(), std::uint8_t{1})) /
         static_cast<double>(unseen.size());
}

TEST(Rectify, WithoutDistortionEveryByteIsCopied) {
  const Rectifier rectifier(kWidth, kHeight, kCaptured, Lens{}, kCaptured);
  ASSERT_TRUE(rectifier.is_identity());
  const cv::Mat padded = test::noise(kHeight, kWidth + 17, 5);
  const cv::Mat image = padded(cv::Rect(0, 0, kWidth, kHeight));
  cv::Mat out(image.size(), CV_8U);
  rectifier.apply(test::view_of(image), out.data);
  EXPECT_EQ(cv::norm(image, out, cv::NORM_INF), 0.0);
  EXPECT_EQ(unseen_ratio(rectifier), 0.0);
}

TEST(Rectify, FisheyeWithoutCoefficientsIsStillNotAPinhole) {
  const Rectifier rectifier(kWidth, kHeight, kCaptured, Lens{LensModel::kFisheye}, kCaptured);
  EXPECT_FALSE(rectifier.is_identity());
}

TEST(Rectify, PixelsOutsideTheCapturedImageAreNamedUnseen) {
  // The published view is wider than the captured one, so all four sides are unseen.
  const PinholePx wide{300.0, 300.0, 317.3, 181.9};
  const Rectifier rectifier(kWidth, kHeight, kCaptured, Lens{}, wide);
  const auto unseen = [&](int u, int v) {
    return rectifier.unseen()[static_cast<std::size_t>(v * kWidth + u)];
  };
  EXPECT_EQ(unseen(0, 180), 1);
  EXPECT_EQ(unseen(kWidth - 1, 180), 1);
  EXPECT_EQ(unseen(320, 0), 1);
  EXPECT_EQ(unseen(320, kHeight - 1), 1);
  EXPECT_EQ(unseen(320, 180), 0);
  // The camera saw (300/420) x (300/422) of the image.
  EXPECT_NEAR(unseen_ratio(rectifier), 1.0 - (300.0 / 420.0) * (300.0 / 422.0), 0.01);
}

TEST(Rectify, BeyondTheFoldOfTheLensPolynomialNothingIsSeen) {
  // r (1 - 0.5 r^2) has its maximum at r = 0.816;
  // rays beyond it project into the image a second time.
  const Lens lens{LensModel::kPlumbBob, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0};
  const PinholePx published{200.0, 200.0, 320.0, 180.0};
  const Rectifier rectifier(kWidth, kHeight, kCaptured, lens, published);
  const auto unseen = [&](int u, int v) {
    return rectifier.unseen()[static_cast<std::size_t>(v * kWidth + u)];
  };
  EXPECT_EQ(unseen(320 + 130, 180), 0);  // r = 0.65
  EXPECT_EQ(unseen(320 + 170, 180), 1);  // r = 0.85 would project to x = 0.54, which is inside
}

}  // namespace
}  // namespace plumb
