/// Test images: a smooth pattern that is known everywhere, and noise.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <random>

#include "core/image_view.hpp"

namespace plumb::test {

inline ImageView view_of(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step[0])};
}

/// Expects the size and every pixel of `expected`.
inline void expect_pixels(const ImageView& image, const cv::Mat& expected) {
  ASSERT_EQ(image.width_px, expected.cols);
  ASSERT_EQ(image.height_px, expected.rows);
  for (int v = 0; v < expected.rows; ++v)
    EXPECT_TRUE(std::equal(image.row(v), image.row(v) + expected.cols, expected.ptr(v)));
}

/// Waves in every direction that are long enough for bilinear sampling to stay within a grey level.
inline cv::Mat waves(int width_px, int height_px) {
  cv::Mat image(height_px, width_px, CV_8U);
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const double grey =
          128.0 + 50.0 * std::sin(0.21 * u + 0.07 * v) + 50.0 * std::cos(0.17 * v - 0.05 * u);
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(std::lround(grey));
    }
  }
  return image;
}

inline cv::Mat noise(int rows, int bytes_per_row, unsigned seed) {
  cv::Mat image(rows, bytes_per_row, CV_8U);
  std::mt19937 random(seed);
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < bytes_per_row; ++u) {
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(random() & 0xFFU);
    }
  }
  return image;
}

}  // namespace plumb::test
