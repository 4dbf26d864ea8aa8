#include "modules/camera/ego_mask.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>

namespace plumb {
namespace {

struct Corner {
  double u_px;
  double v_px;
};

bool take_number(std::string_view* text, double* value) {
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), *value);
  if (error != std::errc() || !std::isfinite(*value)) return false;
  text->remove_prefix(static_cast<std::size_t>(end - text->data()));
  return true;
}

void skip_spaces(std::string_view* text) {
  while (!text->empty() && text->front() == ' ') text->remove_prefix(1);
}

bool parse_corners(std::string_view text, std::vector<Corner>* corners) {
  for (skip_spaces(&text); !text.empty(); skip_spaces(&text)) {
    Corner corner{};
    if (!take_number(&text, &corner.u_px)) return false;
    if (text.empty() || text.front() != ',') return false;
    text.remove_prefix(1);
    if (!take_number(&text, &corner.v_px)) return false;
    if (!text.empty() && text.front() != ' ') return false;
    corners->push_back(corner);
  }
  return corners->size() >= 3;
}

bool is_inside(const std::vector<Corner>& corners, double u_px, double v_px) {
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Corner& a = corners[i];
    const Corner& b = corners[j];
    if ((a.v_px > v_px) == (b.v_px > v_px)) continue;
    if (u_px < (b.u_px - a.u_px) * (v_px - a.v_px) / (b.v_px - a.v_px) + a.u_px) inside = !inside;
  }
  return inside;
}

/// Distance of each pixel to the nearest covered one, in thirds of a pixel (chamfer 3-4 distance
/// transform; Borgefors 1986).
std::vector<int> chamfer(const std::vector<std::uint8_t>& covered, int width, int height) {
  constexpr int kFar = std::numeric_limits<int>::max() / 2;
  std::vector<int> d(covered.size());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = covered[i] != 0 ? 0 : kFar;
  const auto index = [width](int u, int v) {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(u);
  };
  const auto at = [&](int u, int v) {
    return u < 0 || v < 0 || u >= width || v >= height ? kFar : d[index(u, v)];
  };
  const auto relax = [&](int u, int v, int s) {
    int& here = d[index(u, v)];
    here = std::min(
        {here, at(u - s, v) + 3, at(u, v - s) + 3, at(u - s, v - s) + 4, at(u + s, v - s) + 4});
  };
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) relax(u, v, 1);
  }
  for (int v = height - 1; v >= 0; --v) {
    for (int u = width - 1; u >= 0; --u) relax(u, v, -1);
  }
  return d;
}

}  // namespace

MaskPainter::MaskPainter(int width_px, int height_px)
    : width_px_(width_px),
      height_px_(height_px),
      covered_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), 0) {}

void MaskPainter::add_rows(int num_top, int num_bottom) {
  const auto width = static_cast<std::ptrdiff_t>(width_px_);
  std::fill_n(covered_.begin(), width * std::min(num_top, height_px_), std::uint8_t{1});
  std::fill_n(covered_.rbegin(), width * std::min(num_bottom, height_px_), std::uint8_t{1});
}

void MaskPainter::add_bytes(const std::uint8_t* bytes) {
  for (std::size_t i = 0; i < covered_.size(); ++i) {
    if (bytes[i] != 0) covered_[i] = 1;
  }
}

bool MaskPainter::add_polygon(std::string_view text) {
  std::vector<Corner> corners;
  if (!parse_corners(text, &corners)) return false;
  std::size_t i = 0;
  for (int v = 0; v < height_px_; ++v) {
    for (int u = 0; u < width_px_; ++u, ++i) {
      if (is_inside(corners, u, v)) covered_[i] = 1;
    }
  }
  return true;
}

double MaskPainter::covered_ratio() const {
  const auto count = std::count(covered_.begin(), covered_.end(), std::uint8_t{1});
  return static_cast<double>(count) / static_cast<double>(covered_.size());
}

EgoMask::EgoMask(const MaskPainter& painter, int feather_px) {
  const auto& covered = painter.covered();
  const std::vector<int> distance = chamfer(covered, painter.width_px(), painter.height_px());
  const int reach = 3 * (feather_px + 1);
  bool in_run = false;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    if (distance[i] >= reach) {
      in_run = false;
      continue;
    }
    if (!in_run) {
      runs_.push_back(
          {static_cast<std::uint32_t>(i), 0, static_cast<std::uint32_t>(weights_.size())});
    }
    in_run = true;
    ++runs_.back().length;
    // A smoothstep has no kink at either end of the blend.
    const double x = static_cast<double>(distance[i]) / reach;
    weights_.push_back(static_cast<std::uint16_t>(std::lround(256.0 * x * x * (3.0 - 2.0 * x))));
  }
}

std::uint32_t EgoMask::band_mean(const std::uint8_t* image) const {
  std::uint64_t sum = 0;
  std::uint64_t count = 0;
  for (const Run& run : runs_) {
    const std::uint16_t* weight = weights_.data() + run.weight;
    for (std::uint32_t i = 0; i < run.length; ++i) {
      const std::uint64_t in_band = weight[i] != 0 ? 1 : 0;
      sum += in_band * image[run.begin + i];
      count += in_band;
    }
  }
  constexpr std::uint32_t kMidGrey = 128;
  return count == 0 ? kMidGrey : static_cast<std::uint32_t>((sum + count / 2) / count);
}

void EgoMask::apply(std::uint8_t* image) const {
  if (runs_.empty()) return;
  const std::uint32_t fill = band_mean(image);
  for (const Run& run : runs_) {
    const std::uint16_t* weight = weights_.data() + run.weight;
    std::uint8_t* pixel = image + run.begin;
    for (std::uint32_t i = 0; i < run.length; ++i) {
      const std::uint32_t w = weight[i];
      pixel[i] = static_cast<std::uint8_t>((pixel[i] * w + fill * (256U - w) + 128U) >> 8);
    }
  }
}

}  // namespace plumb
