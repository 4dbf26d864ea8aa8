#include "tools/synth/codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

namespace plumb::synth {
namespace {

constexpr int kReach = 24;                 ///< [px] of the motion search
constexpr float kDeadZone = 1.0F / 6.0F;   ///< rounding of H.264 between pictures
constexpr float kAloneZone = 1.0F / 3.0F;  ///< and within one

int round_up(int value, int unit) { return (value + unit - 1) / unit * unit; }

}  // namespace

Codec::Codec(double step, int width_px, int height_px)
    : step_(static_cast<float>(step)),
      width_(round_up(width_px, kBlock)),
      height_(round_up(height_px, kBlock)),
      picture_width_(width_px),
      picture_height_(height_px) {
  const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  source_.resize(pixels);
  previous_.resize(pixels);
  decoded_.resize(pixels);
  motions_.resize(pixels / (kBlock * kBlock));
}

float Codec::at_previous(int u, int v) const {
  return previous_[static_cast<std::size_t>(std::clamp(v, 0, height_ - 1)) *
                       static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(std::clamp(u, 0, width_ - 1))];
}

float Codec::difference(int u0, int v0, const Motion& motion, float best) const {
  float sum = 0.0F;
  const int u1 = u0 + motion.du;
  const int v1 = v0 + motion.dv;
  const bool inside = u1 >= 0 && v1 >= 0 && u1 + kBlock <= width_ && v1 + kBlock <= height_;
  for (int v = 0; v < kBlock && sum < best; ++v) {
    const float* now = source_.data() + static_cast<std::ptrdiff_t>(v0 + v) * width_ + u0;
    if (inside) {
      const float* then = previous_.data() + static_cast<std::ptrdiff_t>(v1 + v) * width_ + u1;
      float row = 0.0F;
      for (int u = 0; u < kBlock; ++u) row += std::abs(now[u] - then[u]);
      sum += row;
    } else {
      for (int u = 0; u < kBlock; ++u) sum += std::abs(now[u] - at_previous(u1 + u, v1 + v));
    }
  }
  return sum;
}

Codec::Motion Codec::search(int u0, int v0, const Motion& guess) const {
  // Bits for a motion other than the neighbour's cost as much as a difference, so that blocks
  // without texture follow their neighbours.
  const float price = 4.0F * step_;
  const auto cost = [&](const Motion& m, float best) {
    const auto bits = static_cast<float>(std::abs(m.du - guess.du) + std::abs(m.dv - guess.dv));
    const float fee = bits > 0.0F ? price * (1.0F + std::log2(bits + 1.0F)) : 0.0F;
    return fee >= best ? fee : fee + difference(u0, v0, m, best - fee);
  };
  Motion found = guess;
  float least = cost(guess, 1e30F);
  const auto consider = [&](const Motion& m) {
    if (std::abs(m.du) > kReach || std::abs(m.dv) > kReach) return;
    const float value = cost(m, least);
    if (value >= least) return;
    least = value;
    found = m;
  };
  consider({0, 0});
  for (int stride = 8; stride >= 1; stride /= 2) {
    for (int round = 0; round < 3; ++round) {
      const Motion centre = found;
      for (const auto& [du, dv] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}})
        consider({centre.du + stride * du, centre.dv + stride * dv});
      if (found.du == centre.du && found.dv == centre.dv) break;
    }
  }
  return found;
}

void Codec::predict(int u0, int v0, const Motion& motion) {
  for (int v = v0; v < v0 + kBlock; ++v) {
    float* out = decoded_.data() + static_cast<std::ptrdiff_t>(v) * width_;
    for (int u = u0; u < u0 + kBlock; ++u) out[u] = at_previous(u + motion.du, v + motion.dv);
  }
}

void Codec::predict_flat(int u0, int v0) {
  float sum = 0.0F;
  int count = 0;
  const auto add = [&](int u, int v) {
    if (u < 0 || v < 0) return;
    sum += decoded_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(u)];
    ++count;
  };
  for (int i = 0; i < kBlock; ++i) {
    add(u0 - 1, v0 + i);
    add(u0 + i, v0 - 1);
  }
  const float mean = count > 0 ? sum / static_cast<float>(count) : 128.0F;
  for (int v = v0; v < v0 + kBlock; ++v)
    std::fill_n(decoded_.begin() + static_cast<std::ptrdiff_t>(v) * width_ + u0, kBlock, mean);
}

void Codec::code_residual(int u0, int v0, bool alone) {
  const float zone = alone ? kAloneZone : kDeadZone;
  cv::Matx<float, kTransform, kTransform> residual;
  for (int bv = v0; bv < v0 + kBlock; bv += kTransform) {
    for (int bu = u0; bu < u0 + kBlock; bu += kTransform) {
      const auto at = [&](int v, int u) {
        return static_cast<std::size_t>(bv + v) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(bu + u);
      };
      for (int v = 0; v < kTransform; ++v) {
        for (int u = 0; u < kTransform; ++u)
          residual(v, u) = source_[at(v, u)] - decoded_[at(v, u)];
      }
      cv::dct(residual, residual);
      bool anything = false;
      for (int k = 0; k < kTransform * kTransform; ++k) {
        float& c = residual.val[k];
        const float level = std::floor(std::abs(c) / step_ + zone);
        c = std::copysign(level * step_, c);
        anything = anything || level > 0.0F;
      }
      if (!anything) continue;
      cv::idct(residual, residual);
      for (int v = 0; v < kTransform; ++v) {
        for (int u = 0; u < kTransform; ++u)
          decoded_[at(v, u)] = std::clamp(decoded_[at(v, u)] + residual(v, u), 0.0F, 255.0F);
      }
    }
  }
}

void Codec::smooth_edges() {
  const float limit = 1.2F * step_;
  const auto smooth = [&](std::size_t k, std::size_t across) {
    float& p1 = decoded_[k - 2 * across];
    float& p0 = decoded_[k - across];
    float& q0 = decoded_[k];
    float& q1 = decoded_[k + across];
    if (std::abs(p0 - q0) > limit || std::abs(p1 - p0) > 0.5F * limit ||
        std::abs(q1 - q0) > 0.5F * limit)
      return;
    const float shift =
        std::clamp((4.0F * (q0 - p0) + p1 - q1) / 8.0F, -0.5F * step_, 0.5F * step_);
    p0 += shift;
    q0 -= shift;
  };
  const auto width = static_cast<std::size_t>(width_);
  const auto height = static_cast<std::size_t>(height_);
  for (std::size_t v = 0; v < height; ++v) {
    for (std::size_t u = kTransform; u < width; u += kTransform) smooth(v * width + u, 1);
  }
  for (std::size_t v = kTransform; v < height; v += kTransform) {
    for (std::size_t u = 0; u < width; ++u) smooth(v * width + u, width);
  }
}

void Codec::pass(int frame, std::vector<std::uint8_t>& picture) {
  for (int v = 0; v < height_; ++v) {
    const auto row = static_cast<std::ptrdiff_t>(std::min(v, picture_height_ - 1)) * picture_width_;
    for (int u = 0; u < width_; ++u)
      source_[static_cast<std::size_t>(v * width_ + u)] =
          picture[static_cast<std::size_t>(row + std::min(u, picture_width_ - 1))];
  }
  const bool alone = frame % kGroup == 0;
  std::swap(previous_, decoded_);
  const int blocks = width_ / kBlock;
  for (int v0 = 0; v0 < height_; v0 += kBlock) {
    for (int u0 = 0; u0 < width_; u0 += kBlock) {
      const auto k = static_cast<std::size_t>(v0 / kBlock * blocks + u0 / kBlock);
      motions_[k] = {};
      if (alone) {
        predict_flat(u0, v0);
      } else {
        const Motion guess = u0 > 0   ? motions_[k - 1]
                             : v0 > 0 ? motions_[k - static_cast<std::size_t>(blocks)]
                                      : Motion{};
        motions_[k] = search(u0, v0, guess);
        predict(u0, v0, motions_[k]);
      }
      code_residual(u0, v0, alone);
    }
  }
  smooth_edges();
  for (int v = 0; v < picture_height_; ++v) {
    for (int u = 0; u < picture_width_; ++u)
      picture[static_cast<std::size_t>(v * picture_width_ + u)] = static_cast<std::uint8_t>(
          std::clamp(decoded_[static_cast<std::size_t>(v * width_ + u)] + 0.5F, 0.0F, 255.0F));
  }
}

}  // namespace plumb::synth
