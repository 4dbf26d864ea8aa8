#include "core/pyramid.hpp"

#include <cstring>

namespace plumb {
namespace {

constexpr std::size_t kRowAlignment = 32;
constexpr std::size_t kTailBytes = 64;  // vector loads may read beyond the last pixel

void halve(const ImageView& from, std::uint8_t* to, const ImageView& shape) {
  for (int v = 0; v < shape.height_px; ++v) {
    const std::uint8_t* upper = from.row(2 * v);
    const std::uint8_t* lower = from.row(2 * v + 1);
    std::uint8_t* out = to + v * shape.stride_bytes;
    for (std::ptrdiff_t u = 0; u < shape.width_px; ++u) {
      const int sum = upper[2 * u] + upper[2 * u + 1] + lower[2 * u] + lower[2 * u + 1];
      out[u] = static_cast<std::uint8_t>((sum + 2) >> 2);
    }
  }
}

}  // namespace

Pyramid::Pyramid(int width_px, int height_px, int num_levels) : num_levels_(num_levels) {
  std::array<std::size_t, kMaxLevels> offsets{};
  std::size_t total = 0;
  for (int l = 0; l < num_levels_; ++l) {
    const auto i = static_cast<std::size_t>(l);
    const auto width = static_cast<std::size_t>(width_px >> l);
    const std::size_t stride = (width + kRowAlignment - 1) / kRowAlignment * kRowAlignment;
    views_[i] = {nullptr, width_px >> l, height_px >> l, static_cast<std::ptrdiff_t>(stride)};
    offsets[i] = total;
    total += stride * static_cast<std::size_t>(height_px >> l) + kTailBytes;
  }
  storage_.resize(total);
  for (int l = 0; l < num_levels_; ++l) {
    const auto i = static_cast<std::size_t>(l);
    views_[i].data = storage_.data() + offsets[i];
  }
}

void Pyramid::build(const ImageView& image) {
  const auto base = [this](int l) {
    return storage_.data() + (views_[static_cast<std::size_t>(l)].data - storage_.data());
  };
  for (int v = 0; v < views_[0].height_px; ++v) {
    std::memcpy(base(0) + v * views_[0].stride_bytes, image.row(v),
                static_cast<std::size_t>(views_[0].width_px));
  }
  for (int l = 1; l < num_levels_; ++l) {
    const auto i = static_cast<std::size_t>(l);
    halve(views_[i - 1], base(l), views_[i]);
  }
}

}  // namespace plumb
