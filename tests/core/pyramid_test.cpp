#include "core/pyramid.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace plumb {
namespace {

/// A ramp a + b u + c v. Its averages are ramps as well, so the expected value of every level is
/// exact.
std::vector<std::uint8_t> ramp(int width, int height, int stride) {
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(stride) *
                                   static_cast<std::size_t>(height));
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      pixels[static_cast<std::size_t>(v * stride + u)] = static_cast<std::uint8_t>(10 + 2 * u + v);
    }
  }
  return pixels;
}

TEST(Pyramid, LevelsHalveAndOddRestIsDropped) {
  const Pyramid pyramid(83, 37, 3);
  EXPECT_EQ(pyramid.level(0).width_px, 83);
  EXPECT_EQ(pyramid.level(1).width_px, 41);
  EXPECT_EQ(pyramid.level(2).width_px, 20);
  EXPECT_EQ(pyramid.level(2).height_px, 9);
}

TEST(Pyramid, EveryLevelSamplesTheSameRamp) {
  const int stride = 96;
  const std::vector<std::uint8_t> pixels = ramp(83, 37, stride);
  Pyramid pyramid(83, 37, 3);
  pyramid.build({pixels.data(), 83, 37, stride});
  for (int l = 0; l < 3; ++l) {
    const ImageView& image = pyramid.level(l);
    for (int v = 0; v < image.height_px; ++v) {
      for (int u = 0; u < image.width_px; ++u) {
        const double expected = 10.0 + 2.0 * Pyramid::from_level(u, l) + Pyramid::from_level(v, l);
        ASSERT_NEAR(image.at(u, v), expected, 0.51 * l)
            << "level " << l << " at " << u << ", " << v;
      }
    }
  }
}

TEST(Pyramid, LevelCoordinatesRoundTrip) {
  for (int l = 0; l < Pyramid::kMaxLevels; ++l) {
    EXPECT_DOUBLE_EQ(Pyramid::from_level(Pyramid::to_level(123.25, l), l), 123.25);
  }
  EXPECT_DOUBLE_EQ(Pyramid::to_level(0.5, 1), 0.0);  // centre of the first 2x2 block
}

}  // namespace
}  // namespace plumb
