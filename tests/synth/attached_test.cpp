#include "tools/synth/attached.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plumb::synth {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

/// A frame whose upper half sends `light` and whose lower half is a road of tone `road`.
RenderedFrame road_under_sky(float light, float road) {
  RenderedFrame frame;
  frame.width_px = kWidth;
  frame.height_px = kHeight;
  frame.radiance.assign(kWidth * kHeight, road);
  std::fill_n(frame.radiance.begin(), kWidth * kHeight / 2, light);
  frame.distance_m.assign(kWidth * kHeight, 7.0F);
  frame.object.assign(kWidth * kHeight, FrameRenderer::kRoad);
  return frame;
}

std::size_t at(int u, int v) { return static_cast<std::size_t>(v * kWidth + u); }

class AttachedTest : public testing::Test {
 protected:
  Textures textures_{3};
};

TEST_F(AttachedTest, NothingAttachedChangesNothing) {
  RenderedFrame frame = road_under_sky(1.0F, 0.2F);
  Attached({}, textures_, kWidth, kHeight).lay_over(frame);
  EXPECT_EQ(frame.radiance, road_under_sky(1.0F, 0.2F).radiance);
}

TEST_F(AttachedTest, DashboardHidesTheBottomWhateverIsBehindIt) {
  AttachedConfig config;
  config.dashboard = 0.25;
  const Attached attached(config, textures_, kWidth, kHeight);
  RenderedFrame one = road_under_sky(1.0F, 0.2F);
  RenderedFrame other = road_under_sky(1.0F, 0.7F);
  attached.lay_over(one);
  attached.lay_over(other);
  for (int u = 0; u < kWidth; u += 7) {
    EXPECT_EQ(one.radiance[at(u, 115)], other.radiance[at(u, 115)]);
    EXPECT_EQ(one.object[at(u, 115)], FrameRenderer::kNothing);
    EXPECT_EQ(one.distance_m[at(u, 115)], 0.0F);
    EXPECT_EQ(one.radiance[at(u, 70)], 0.2F) << "the road above it is seen";
  }
}

TEST_F(AttachedTest, ReflectionsAddTheSamePatternWhateverPassesBehind) {
  AttachedConfig config;
  config.reflections = 1.0;
  const Attached attached(config, textures_, kWidth, kHeight);
  RenderedFrame one = road_under_sky(1.0F, 0.2F);
  RenderedFrame other = road_under_sky(1.0F, 0.3F);
  RenderedFrame dim = road_under_sky(0.5F, 0.2F);
  attached.lay_over(one);
  attached.lay_over(other);
  attached.lay_over(dim);
  float strongest = 0.0F;
  for (int v = 65; v < kHeight; v += 3) {
    for (int u = 0; u < kWidth; u += 7) {
      const float veil = one.radiance[at(u, v)] - 0.2F;
      EXPECT_NEAR(other.radiance[at(u, v)] - 0.3F, veil, 1e-6F);
      EXPECT_NEAR(dim.radiance[at(u, v)] - 0.2F, 0.5F * veil, 1e-6F) << "half the light";
      strongest = std::max(strongest, veil);
    }
  }
  EXPECT_GT(strongest, 0.03F);
}

TEST_F(AttachedTest, BonnetMirrorsTheScene) {
  AttachedConfig config;
  config.bonnet = 0.15;
  const Attached attached(config, textures_, kWidth, kHeight);
  RenderedFrame dark = road_under_sky(1.0F, 0.1F);
  RenderedFrame bright = road_under_sky(1.0F, 0.6F);
  attached.lay_over(dark);
  attached.lay_over(bright);
  const std::size_t k = at(kWidth / 2, 108);
  EXPECT_GT(bright.radiance[k], dark.radiance[k] + 0.05F);
  EXPECT_LT(bright.radiance[k], 0.5F * 0.6F);
  EXPECT_EQ(bright.object[k], FrameRenderer::kNothing);
}

}  // namespace
}  // namespace plumb::synth
