#include "tools/synth/noise_texture.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"

namespace plumb::synth {
namespace {

constexpr float kUnit = 1.0F / 4096.0F;  ///< value of one count of a stored texel
constexpr int kMaxTaps = 6;

double smooth(double t) { return t * t * (3.0 - 2.0 * t); }

/// Adds white noise of `cells` x `cells`, enlarged smoothly to `size`, with standard deviation
/// `weight`.
void add_octave(std::vector<double>& sum, int size, int cells, double weight, Random& random) {
  const auto n = static_cast<std::size_t>(cells);
  std::vector<double> white(n * n);
  for (double& value : white) value = random.normal();
  const int step = size / cells;
  std::size_t k = 0;
  for (int y = 0; y < size; ++y) {
    const auto y0 = static_cast<std::size_t>(y / step);
    const double fy = smooth(static_cast<double>(y % step) / step);
    for (int x = 0; x < size; ++x, ++k) {
      const auto x0 = static_cast<std::size_t>(x / step);
      const double fx = smooth(static_cast<double>(x % step) / step);
      const std::size_t x1 = (x0 + 1) % n;
      const std::size_t y1 = (y0 + 1) % n;
      const double top = white[y0 * n + x0] * (1.0 - fx) + white[y0 * n + x1] * fx;
      const double bottom = white[y1 * n + x0] * (1.0 - fx) + white[y1 * n + x1] * fx;
      sum[k] += weight * (top * (1.0 - fy) + bottom * fy);
    }
  }
}

std::vector<double> halve(const std::vector<double>& fine, int size) {
  const int half = size / 2;
  std::vector<double> coarse(static_cast<std::size_t>(half) * static_cast<std::size_t>(half));
  for (int y = 0; y < half; ++y) {
    for (int x = 0; x < half; ++x) {
      const auto at = static_cast<std::size_t>(2 * y) * static_cast<std::size_t>(size) +
                      static_cast<std::size_t>(2 * x);
      const auto below = at + static_cast<std::size_t>(size);
      coarse[static_cast<std::size_t>(y) * static_cast<std::size_t>(half) +
             static_cast<std::size_t>(x)] =
          0.25 * (fine[at] + fine[at + 1] + fine[below] + fine[below + 1]);
    }
  }
  return coarse;
}

void normalise(std::vector<double>& values) {
  double mean = 0.0;
  for (const double v : values) mean += v;
  mean /= static_cast<double>(values.size());
  double square = 0.0;
  for (const double v : values) square += (v - mean) * (v - mean);
  const double scale = 1.0 / std::sqrt(square / static_cast<double>(values.size()));
  for (double& v : values) v = (v - mean) * scale;
}

}  // namespace

NoiseTexture::NoiseTexture(int log2_size, double texel_m, const std::vector<double>& weights,
                           std::uint64_t seed)
    : texel_m_(texel_m) {
  int size = 1 << log2_size;
  std::vector<double> values(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  Random random(seed);
  for (std::size_t octave = 0; octave < weights.size(); ++octave) {
    add_octave(values, size, size >> octave, weights[octave], random);
  }
  normalise(values);
  for (int level = log2_size; level >= 0; --level, size /= 2) {
    Level stored;
    stored.log2_size = level;
    stored.texels.reserve(values.size());
    for (const double v : values) {
      stored.texels.push_back(static_cast<std::int16_t>(
          std::lround(std::clamp(v / static_cast<double>(kUnit), -32767.0, 32767.0))));
    }
    levels_.push_back(std::move(stored));
    if (level > 0) values = halve(values, size);
  }
}

inline float NoiseTexture::bilinear(const Level& level, double x_texel, double y_texel) const {
  const double xf = std::floor(x_texel);
  const double yf = std::floor(y_texel);
  const auto fx = static_cast<float>(x_texel - xf);
  const auto fy = static_cast<float>(y_texel - yf);
  const unsigned mask = (1U << level.log2_size) - 1U;
  const auto x0 = static_cast<unsigned>(static_cast<int>(xf)) & mask;
  const auto y0 = (static_cast<unsigned>(static_cast<int>(yf)) & mask) << level.log2_size;
  const unsigned x1 = (x0 + 1U) & mask;
  const unsigned y1 = (y0 + (1U << level.log2_size)) & ((1U << (2 * level.log2_size)) - 1U);
  const std::int16_t* t = level.texels.data();
  const auto a = static_cast<float>(t[y0 + x0]);
  const auto b = static_cast<float>(t[y0 + x1]);
  const auto c = static_cast<float>(t[y1 + x0]);
  const auto d = static_cast<float>(t[y1 + x1]);
  const float top = a + (b - a) * fx;
  const float bottom = c + (d - c) * fx;
  return (top + (bottom - top) * fy) * kUnit;
}

float NoiseTexture::sample(double x_m, double y_m, const Footprint& pixel) const {
  const double to_texels = 1.0 / texel_m_;
  const double ax = pixel.axis_x_m * to_texels;
  const double ay = pixel.axis_y_m * to_texels;
  const double major = std::sqrt(ax * ax + ay * ay);
  const double minor = std::max({pixel.minor_m * to_texels, major / kMaxTaps, 1.0});
  int exponent = 0;
  const double mantissa =
      std::frexp(minor, &exponent);  // minor = mantissa 2^exponent, mantissa in [0.5, 1)
  const auto level = static_cast<std::size_t>(exponent - 1);
  if (level + 1 >= levels_.size()) return 0.0F;
  const auto blend = static_cast<float>(2.0 * mantissa - 1.0);
  const int taps = std::max(1, static_cast<int>(major / minor + 0.99));
  const double scale = 1.0 / static_cast<double>(1U << level);
  const double x = x_m * to_texels * scale;
  const double y = y_m * to_texels * scale;
  const auto average = [&](std::size_t at, int count, double shrink) {
    const double step_x = ax * scale * shrink / count;
    const double step_y = ay * scale * shrink / count;
    double tx = x * shrink - 0.5 - 0.5 * step_x * (count - 1);
    double ty = y * shrink - 0.5 - 0.5 * step_y * (count - 1);
    float sum = 0.0F;
    for (int i = 0; i < count; ++i, tx += step_x, ty += step_y)
      sum += bilinear(levels_[at], tx, ty);
    return sum / static_cast<float>(count);
  };
  const float fine = average(level, taps, 1.0);
  const float coarse = average(level + 1, (taps + 1) / 2, 0.5);
  return fine + (coarse - fine) * blend;
}

float NoiseTexture::sample(double x_m, double y_m, double width_m) const {
  return sample(x_m, y_m, Footprint{0.0, 0.0, width_m});
}

VolumeNoise::VolumeNoise(std::uint64_t seed) : lattice_(64 * 64 * 64) {
  Random random(seed);
  for (std::uint8_t& value : lattice_) value = static_cast<std::uint8_t>(random.next() >> 56);
}

float VolumeNoise::sample(double x, double y, double z) const {
  const double xf = std::floor(x);
  const double yf = std::floor(y);
  const double zf = std::floor(z);
  const auto ease = [](double t) { return static_cast<float>(smooth(t)); };
  const float fx = ease(x - xf);
  const float fy = ease(y - yf);
  const float fz = ease(z - zf);
  const auto wrap = [](double v) {
    return static_cast<unsigned>(static_cast<std::int64_t>(v)) & 63U;
  };
  const unsigned x0 = wrap(xf);
  const unsigned x1 = (x0 + 1U) & 63U;
  const unsigned y0 = wrap(yf) << 6U;
  const unsigned y1 = (y0 + 64U) & 4095U;
  const unsigned z0 = wrap(zf) << 12U;
  const unsigned z1 = (z0 + 4096U) & 262143U;
  const auto at = [this](unsigned i) { return static_cast<float>(lattice_[i]); };
  const auto mixed = [](float a, float b, float t) { return a + (b - a) * t; };
  const float a = mixed(mixed(at(x0 + y0 + z0), at(x1 + y0 + z0), fx),
                        mixed(at(x0 + y1 + z0), at(x1 + y1 + z0), fx), fy);
  const float b = mixed(mixed(at(x0 + y0 + z1), at(x1 + y0 + z1), fx),
                        mixed(at(x0 + y1 + z1), at(x1 + y1 + z1), fx), fy);
  return mixed(a, b, fz) * (1.0F / 255.0F);
}

}  // namespace plumb::synth
