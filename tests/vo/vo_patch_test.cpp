#include <gtest/gtest.h>

#include <cmath>

#include "modules/vo/klt.hpp"
#include "modules/vo/patch.hpp"

namespace plumb::vo {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

/// A smooth texture that can be sampled anywhere.
struct Texture {
  static double at(double u, double v) {
    return 125.0 + 30.0 * std::sin(0.31 * u + 0.12 * v) + 25.0 * std::sin(0.17 * u - 0.41 * v) +
           32.0 * std::sin(0.09 * u + 0.03 * v + 1.0) + 32.0 * std::sin(0.02 * u - 0.10 * v);
  }
};

struct TestImage {
  std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(kWidth * kHeight + 64);
  [[nodiscard]] ImageView view() const { return {pixels.data(), kWidth, kHeight, kWidth}; }
};

/// Returns an image whose pixel x shows the texture at centre + A (x - centre - shift).
TestImage warped(const Eigen::Matrix2d& A, const Eigen::Vector2d& shift, double gain, double bias) {
  const Eigen::Vector2d centre(80.0, 60.0);
  TestImage image;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const Eigen::Vector2d x = centre + A * (Eigen::Vector2d(u, v) - centre - shift);
      const double grey = gain * Texture::at(x.x(), x.y()) + bias;
      image.pixels[static_cast<std::size_t>(v * kWidth + u)] =
          static_cast<std::uint8_t>(std::clamp(grey + 0.5, 0.0, 255.0));
    }
  }
  return image;
}

TEST(Patch, FindsAShiftToAFiftiethOfAPixel) {
  const TestImage a = warped(Eigen::Matrix2d::Identity(), {0.0, 0.0}, 1.0, 0.0);
  for (const double s : {-1.3, -0.4, 0.25, 0.75, 1.6}) {
    const TestImage b = warped(Eigen::Matrix2d::Identity(), {s, -0.5 * s}, 1.0, 0.0);
    Patch<5> patch;
    ASSERT_TRUE(patch.cut(a.view(), {80.0F, 60.0F}));
    const Alignment found = patch.align(b.view(), {80.0F, 60.0F}, {});
    ASSERT_TRUE(found.ok());
    EXPECT_NEAR(found.px.x(), 80.0 + s, 0.02);
    EXPECT_NEAR(found.px.y(), 60.0 - 0.5 * s, 0.02);
    EXPECT_GT(found.ncc, 0.99F);
  }
}

TEST(Patch, IsInvariantToGainAndBrightness) {
  const TestImage a = warped(Eigen::Matrix2d::Identity(), {0.0, 0.0}, 1.0, 0.0);
  const TestImage b = warped(Eigen::Matrix2d::Identity(), {0.6, 0.3}, 0.5, 70.0);
  Patch<5> patch;
  ASSERT_TRUE(patch.cut(a.view(), {80.0F, 60.0F}));
  const Alignment found = patch.align(b.view(), {80.0F, 60.0F}, {});
  ASSERT_TRUE(found.ok());
  EXPECT_NEAR(found.px.x(), 80.6, 0.03);
  EXPECT_NEAR(found.px.y(), 60.3, 0.03);
}

TEST(Patch, AWarpedTemplateMatchesAScaledAndTurnedImage) {
  Eigen::Matrix2d A;  // offset in b -> offset in a
  A << 0.8 * std::cos(0.1), -0.8 * std::sin(0.1), 0.8 * std::sin(0.1), 0.8 * std::cos(0.1);
  const TestImage a = warped(Eigen::Matrix2d::Identity(), {0.0, 0.0}, 1.0, 0.0);
  const TestImage b = warped(A, {0.4, -0.7}, 1.0, 0.0);
  Patch<5> patch;
  ASSERT_TRUE(patch.cut(a.view(), {80.0F, 60.0F}, A.cast<float>()));
  const Alignment found = patch.align(b.view(), {80.0F, 60.0F}, {});
  ASSERT_TRUE(found.ok());
  EXPECT_NEAR(found.px.x(), 80.4, 0.03);
  EXPECT_NEAR(found.px.y(), 59.3, 0.03);
  EXPECT_GT(found.ncc, 0.99F);
}

TEST(Patch, RefusesFlatPatchesAndTheEdgeOfTheImage) {
  TestImage flat;
  std::fill(flat.pixels.begin(), flat.pixels.end(), static_cast<std::uint8_t>(90));
  Patch<7> patch;
  EXPECT_FALSE(patch.cut(flat.view(), {80.0F, 60.0F}));
  const TestImage a = warped(Eigen::Matrix2d::Identity(), {0.0, 0.0}, 1.0, 0.0);
  for (const float u : {-5.0F, 0.0F, 7.5F, 152.0F, 500.0F}) {
    EXPECT_FALSE(patch.cut(a.view(), {u, 60.0F})) << u;
    EXPECT_FALSE(patch.cut(a.view(), {u, 60.0F}, Eigen::Matrix2f::Identity())) << u;
  }
  ASSERT_TRUE(patch.cut(a.view(), {80.0F, 60.0F}));
  EXPECT_FALSE(patch.align(a.view(), {3.0F, 60.0F}, {}).ok());
  EXPECT_FALSE(patch.align(a.view(), {std::nanf(""), 60.0F}, {}).ok());
}

TEST(Klt, FollowsALargeMotionThroughThePyramid) {
  Pyramid from(kWidth, kHeight, 4);
  Pyramid to(kWidth, kHeight, 4);
  from.build(warped(Eigen::Matrix2d::Identity(), {0.0, 0.0}, 1.0, 0.0).view());
  to.build(warped(Eigen::Matrix2d::Identity(), {5.3, -3.6}, 1.0, 0.0).view());
  const KltMatch found = klt_search(from, {80.0F, 60.0F}, to, {80.0F, 60.0F}, 1.0F, 2);
  ASSERT_TRUE(found.ok());
  EXPECT_NEAR(found.px.x(), 85.3, 0.03);
  EXPECT_NEAR(found.px.y(), 56.4, 0.03);
}

TEST(Klt, UsesTheExpectedChangeOfSize) {
  Pyramid from(kWidth, kHeight, 4);
  Pyramid to(kWidth, kHeight, 4);
  from.build(warped(Eigen::Matrix2d::Identity(), {0.0, 0.0}, 1.0, 0.0).view());
  to.build(warped(Eigen::Matrix2d::Identity() / 1.25, {1.0, 1.0}, 1.0, 0.0).view());
  const KltMatch found = klt_search(from, {80.0F, 60.0F}, to, {80.0F, 60.0F}, 1.25F, 1);
  ASSERT_TRUE(found.ok());
  EXPECT_NEAR(found.px.x(), 81.0, 0.04);
  EXPECT_NEAR(found.px.y(), 61.0, 0.04);
  EXPECT_GT(found.ncc, 0.99F);
}

}  // namespace
}  // namespace plumb::vo
