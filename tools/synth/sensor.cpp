#include "tools/synth/sensor.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"

namespace plumb::synth {
namespace {

/// A nearly normal number from one hash, as the sum of four 16-bit uniforms.
float cheap_normal(std::uint64_t h) {
  const std::uint64_t sum =
      (h & 0xffffU) + ((h >> 16) & 0xffffU) + ((h >> 32) & 0xffffU) + (h >> 48);
  return (static_cast<float>(sum) - 131070.0F) * (1.0F / 37837.2F);
}

/// Slow noise that is smooth between independent values every `period_s`.
double wander(std::uint64_t seed, double time_s, double period_s) {
  const double x = time_s / period_s;
  const double k = std::floor(x);
  const double f = x - k;
  const auto value = [&](double i) {
    Random random(hash_keys(seed, static_cast<std::uint64_t>(i + 1000.0), 0xe4));
    return random.normal();
  };
  const double t = f * f * (3.0 - 2.0 * f);
  return value(k) * (1.0 - t) + value(k + 1.0) * t;
}

}  // namespace

double Sensor::exposure(double time_s) const {
  double factor = std::exp(config_.gain_drift * wander(config_.seed, time_s, 3.0));
  if (config_.step_every_s > 0.0) {
    const auto steps = static_cast<std::int64_t>(std::floor(time_s / config_.step_every_s));
    if (steps % 2 == 1) factor *= config_.step_factor;
  }
  return factor;
}

void Sensor::blur(int width, int height) {
  if (config_.blur_px <= 0.0) return;
  const int radius = std::max(1, static_cast<int>(std::ceil(2.5 * config_.blur_px)));
  std::vector<float> kernel;
  double total = 0.0;
  for (int k = -radius; k <= radius; ++k)
    total += std::exp(-0.5 * k * k / (config_.blur_px * config_.blur_px));
  for (int k = -radius; k <= radius; ++k) {
    kernel.push_back(
        static_cast<float>(std::exp(-0.5 * k * k / (config_.blur_px * config_.blur_px)) / total));
  }
  for (int v = 0; v < height; ++v) {
    const float* row = image_.data() + static_cast<std::ptrdiff_t>(v) * width;
    float* target = scratch_.data() + static_cast<std::ptrdiff_t>(v) * width;
    for (int u = 0; u < width; ++u) {
      float sum = 0.0F;
      for (int k = -radius; k <= radius; ++k)
        sum += kernel[static_cast<std::size_t>(k + radius)] * row[std::clamp(u + k, 0, width - 1)];
      target[u] = sum;
    }
  }
  for (int v = 0; v < height; ++v) {
    float* target = image_.data() + static_cast<std::ptrdiff_t>(v) * width;
    std::fill(target, target + width, 0.0F);
    for (int k = -radius; k <= radius; ++k) {
      const float* row =
          scratch_.data() + static_cast<std::ptrdiff_t>(std::clamp(v + k, 0, height - 1)) * width;
      const float weight = kernel[static_cast<std::size_t>(k + radius)];
      for (int u = 0; u < width; ++u) target[u] += weight * row[u];
    }
  }
}

void Sensor::develop(const RenderedFrame& in, double time_s, std::uint64_t frame, double light,
                     std::vector<std::uint8_t>& out) {
  const int width = in.width_px;
  const int height = in.height_px;
  image_ = in.radiance;
  scratch_.resize(image_.size());
  // Light beyond ten times white would blur into stars, but the sensor's wells are full long
  // before.
  for (float& value : image_) value = std::min(value, 4.0F);
  blur(width, height);
  const auto gain = static_cast<float>(config_.gain * exposure(time_s) * light);
  const auto shot = static_cast<float>(config_.shot_noise);
  const auto read2 = static_cast<float>(config_.read_noise * config_.read_noise);
  const auto gamma = static_cast<float>(config_.gamma);
  const bool curved = config_.gamma != 1.0;
  const double reach =
      1.0 / (0.25 * (static_cast<double>(width) * width + static_cast<double>(height) * height));
  out.resize(image_.size());
  const std::uint64_t stream = hash_keys(config_.seed, frame, 0x5e);
  std::size_t k = 0;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u, ++k) {
      const double du = u - 0.5 * width;
      const double dv = v - 0.5 * height;
      const auto fall = static_cast<float>(1.0 - config_.vignetting * (du * du + dv * dv) * reach);
      float clean = gain * fall * image_[k];
      if (curved) clean = 255.0F * std::pow(clean / 255.0F, gamma);
      const float noisy = clean + std::sqrt(read2 + shot * clean) * cheap_normal(mix(stream + k));
      out[k] = static_cast<std::uint8_t>(std::clamp(noisy + 0.5F, 0.0F, 255.0F));
    }
  }
}

}  // namespace plumb::synth
