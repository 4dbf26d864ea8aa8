#include "tools/synth/attached.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plumb::synth {
namespace {

constexpr int kPanelWidth = 160;
constexpr int kPanelHeight = 120;

/// A frame whose upper half sends `light` and whose lower half is a road of tone `road`.
RenderedFrame road_under_sky(float light, float road) {
  RenderedFrame frame;
  frame.width_px = kPanelWidth;
  frame.height_px = kPanelHeight;
  frame.radiance.assign(kPanelWidth * kPanelHeight, road);
  std::fill_n(frame.radiance.begin(), kPanelWidth * kPanelHeight / 2, light);
  frame.distance_m.assign(kPanelWidth * kPanelHeight, 7.0F);
  frame.object.assign(kPanelWidth * kPanelHeight, FrameRenderer::kRoad);
  return frame;
}

std::size_t pixel_at(int u, int v) { return static_cast<std::size_t>(v * kPanelWidth + u); }

class AttachedTest : public testing::Test {
 protected:
  inline static const Textures textures_{3};
};

TEST_F(AttachedTest, NothingAttachedChangesNothing) {
  RenderedFrame frame = road_under_sky(1.0F, 0.2F);
  Attached({}, textures_, kPanelWidth, kPanelHeight).lay_over(frame);
  EXPECT_EQ(frame.radiance, road_under_sky(1.0F, 0.2F).radiance);
}

TEST_F(AttachedTest, DashboardHidesTheBottomWhateverIsBehindIt) {
  AttachedConfig config;
  config.dashboard = 0.25;
  const Attached attached(config, textures_, kPanelWidth, kPanelHeight);
  RenderedFrame one = road_under_sky(1.0F, 0.2F);
  RenderedFrame other = road_under_sky(1.0F, 0.7F);
  attached.lay_over(one);
  attached.lay_over(other);
  for (int u = 0; u < kPanelWidth; u += 7) {
    EXPECT_EQ(one.radiance[pixel_at(u, 115)], other.radiance[pixel_at(u, 115)]);
    EXPECT_EQ(one.object[pixel_at(u, 115)], FrameRenderer::kNothing);
    EXPECT_EQ(one.distance_m[pixel_at(u, 115)], 0.0F);
    EXPECT_EQ(one.radiance[pixel_at(u, 70)], 0.2F) << "the road above it is seen";
  }
}

TEST_F(AttachedTest, ReflectionsAddTheSamePatternWhateverPassesBehind) {
  AttachedConfig config;
  config.reflections = 1.0;
  const Attached attached(config, textures_, kPanelWidth, kPanelHeight);
  RenderedFrame one = road_under_sky(1.0F, 0.2F);
  RenderedFrame other = road_under_sky(1.0F, 0.3F);
  RenderedFrame dim = road_under_sky(0.5F, 0.2F);
  attached.lay_over(one);
  attached.lay_over(other);
  attached.lay_over(dim);
  float strongest = 0.0F;
  for (int v = 65; v < kPanelHeight; v += 3) {
    for (int u = 0; u < kPanelWidth; u += 7) {
      const float veil = one.radiance[pixel_at(u, v)] - 0.2F;
      EXPECT_NEAR(other.radiance[pixel_at(u, v)] - 0.3F, veil, 1e-6F);
      EXPECT_NEAR(dim.radiance[pixel_at(u, v)] - 0.2F, 0.5F * veil, 1e-6F) << "half the light";
      strongest = std::max(strongest, veil);
    }
  }
  EXPECT_GT(strongest, 0.03F);
}

TEST_F(AttachedTest, BonnetMirrorsTheScene) {
  AttachedConfig config;
  config.bonnet = 0.15;
  const Attached attached(config, textures_, kPanelWidth, kPanelHeight);
  RenderedFrame dark = road_under_sky(1.0F, 0.1F);
  RenderedFrame bright = road_under_sky(1.0F, 0.6F);
  attached.lay_over(dark);
  attached.lay_over(bright);
  const std::size_t k = pixel_at(kPanelWidth / 2, 108);
  EXPECT_GT(bright.radiance[k], dark.radiance[k] + 0.05F);
  EXPECT_LT(bright.radiance[k], 0.5F * 0.6F);
  EXPECT_EQ(bright.object[k], FrameRenderer::kNothing);
}

}  // namespace
}  // namespace plumb::synth
