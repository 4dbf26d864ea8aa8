#include "tools/synth/attached.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"

namespace plumb::synth {
namespace {

/// 1 below a row, 0 above it, with an edge of two pixels.
float below(double row, int v) {
  return static_cast<float>(std::clamp(0.5 * (v - row) + 0.5, 0.0, 1.0));
}

/// Mean light that falls through the windscreen: that of the picture's upper half.
float light_outside(const RenderedFrame& frame) {
  double sum = 0.0;
  int count = 0;
  for (int v = 0; v < frame.height_px / 2; v += 8) {
    for (int u = 0; u < frame.width_px; u += 8, ++count) {
      const auto k = static_cast<std::size_t>(v) * static_cast<std::size_t>(frame.width_px) +
                     static_cast<std::size_t>(u);
      sum += std::min(2.0, static_cast<double>(frame.radiance[k]));
    }
  }
  return static_cast<float>(sum / std::max(1, count));
}

}  // namespace

Attached::Attached(const AttachedConfig& config, const Textures& textures, int width_px,
                   int height_px)
    : width_px_(width_px), height_px_(height_px) {
  if (config.dashboard <= 0.0 && config.bonnet <= 0.0 && config.reflections <= 0.0) return;
  draw_edges(config);
  draw_dashboard(config, textures);
  draw_reflections(config, textures);
}

void Attached::draw_edges(const AttachedConfig& config) {
  Random random(hash_keys(config.seed, 0xda58));
  const double skew = random.uniform(-0.02, 0.02);
  const double cowl = random.uniform(-0.6, 0.6);  // place of the instruments' cowl
  for (int u = 0; u < width_px_; ++u) {
    const double x = 2.0 * (u + 0.5) / width_px_ - 1.0;
    const double arch = 0.03 * x * x + skew * x;
    const double bump = 0.02 * std::exp(-std::pow((x - cowl) / 0.3, 2));
    const double dashboard = 1.0 - config.dashboard + (config.dashboard > 0.0 ? arch - bump : 0.0);
    const double bonnet = 1.0 - config.dashboard - config.bonnet + 0.08 * x * x + 0.5 * skew * x;
    dashboard_top_.push_back(config.dashboard > 0.0 ? height_px_ * dashboard : 1e6);
    bonnet_top_.push_back(config.bonnet > 0.0 ? height_px_ * bonnet : 1e6);
  }
  shares_.resize(static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_));
  std::size_t k = 0;
  for (int v = 0; v < height_px_; ++v) {
    for (std::size_t u = 0; u < dashboard_top_.size(); ++u, ++k)
      shares_[k] = {below(dashboard_top_[u], v), below(bonnet_top_[u], v)};
  }
}

void Attached::draw_dashboard(const AttachedConfig& config, const Textures& textures) {
  tone_.assign(shares_.size(), 0.0F);
  const auto seed = static_cast<double>(config.seed % 97U);
  std::size_t k = 0;
  for (int v = 0; v < height_px_; ++v) {
    for (int u = 0; u < width_px_; ++u, ++k) {
      const double down = (v - dashboard_top_[static_cast<std::size_t>(u)]) / height_px_;
      if (down < -0.01) continue;
      const double x = 2.0 * (u + 0.5) / width_px_;
      const auto grain =
          static_cast<double>(textures.volume.sample(80.0 * x + seed, 80.0 * down + 3.0, 0.5));
      double tone = 0.015 + 0.06 * std::exp(-down / 0.02);
      tone *= 0.7 + 0.6 * grain;
      // A seam and a row of vents.
      tone += 0.05 * coverage(down, 0.045, 0.049, 0.004);
      if (down > 0.07 && down < 0.1) tone *= 1.0 + 1.5 * stripe(x, 0.035, 0.0, 0.012, 0.004) - 0.5;
      tone_[k] = static_cast<float>(std::max(0.0, tone));
    }
  }
}

void Attached::draw_reflections(const AttachedConfig& config, const Textures& textures) {
  veil_.assign(shares_.size(), 0.0F);
  if (config.reflections <= 0.0) return;
  Random random(hash_keys(config.seed, 0x9e71));
  const double sheet_x = random.uniform(0.3, 1.5);  // a sheet of paper on the dashboard
  const double sheet_y = random.uniform(0.05, 0.2);
  const double foot = 1.0 - config.dashboard;
  const double offset = random.uniform(0.0, 60.0);
  std::size_t k = 0;
  for (int v = 0; v < height_px_; ++v) {
    for (int u = 0; u < width_px_; ++u, ++k) {
      const double up = foot - (v + 0.5) / height_px_;  // above the dashboard
      if (up < -0.06 || up > 0.5) continue;
      const double x = 2.0 * (u + 0.5) / width_px_;
      const auto noise = [&](double frequency, double plane) {
        return static_cast<double>(
            textures.volume.sample(frequency * x + offset, 1.6 * frequency * (up + 0.1), plane));
      };
      double veil = 0.35 * noise(3.0, 1.5) + 0.25 * noise(14.0, 4.5) + 0.15 * noise(45.0, 7.5);
      veil += 0.5 * coverage(up, 0.03, 0.036, 0.004);                                      // seam
      veil += 0.4 * coverage(up, 0.06, 0.09, 0.003) * stripe(x, 0.05, 0.0, 0.015, 0.004);  // vents
      veil += 0.8 * coverage(x, sheet_x, sheet_x + 0.22, 0.006) *
              coverage(up, sheet_y, sheet_y + 0.06, 0.004);
      const double fade = std::clamp(1.0 - up / 0.5, 0.0, 1.0);
      veil_[k] = static_cast<float>(0.15 * config.reflections * fade * fade * std::max(0.0, veil));
    }
  }
}

float Attached::mirrored(const RenderedFrame& frame, int u, int v) const {
  const auto column = static_cast<std::size_t>(u);
  // The curved sheet shows the scene upside down and squeezed.
  const double row = bonnet_top_[column] - 0.02 * height_px_ - 4.0 * (v - bonnet_top_[column]);
  const int middle = std::clamp(static_cast<int>(row), 2, height_px_ - 3);
  float sum = 0.0F;
  for (int dv = -2; dv <= 2; ++dv)
    sum += std::min(
        2.0F,
        frame.radiance[static_cast<std::size_t>(middle + dv) * static_cast<std::size_t>(width_px_) +
                       column]);
  return 0.2F * sum;
}

void Attached::lay_over(RenderedFrame& frame) const {
  if (shares_.empty()) return;
  const float light = light_outside(frame);
  // From the bottom up, so that the bonnet mirrors what is not covered yet.
  for (int v = height_px_ - 1; v >= 0; --v) {
    for (int u = 0; u < width_px_; ++u) {
      const auto k = static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px_) +
                     static_cast<std::size_t>(u);
      float& radiance = frame.radiance[k];
      const Shares& share = shares_[k];
      if (share.bonnet > 0.0F && share.dashboard < 1.0F) {
        const float sheet = 0.03F * light + 0.22F * mirrored(frame, u, v);
        radiance = (1.0F - share.bonnet) * radiance + share.bonnet * sheet;
      }
      radiance += light * veil_[k] * (1.0F - share.dashboard);
      radiance = (1.0F - share.dashboard) * radiance + share.dashboard * light * tone_[k];
      if (std::max(share.bonnet, share.dashboard) < 0.5F) continue;
      frame.distance_m[k] = 0.0F;
      frame.object[k] = FrameRenderer::kNothing;
    }
  }
}

}  // namespace plumb::synth
