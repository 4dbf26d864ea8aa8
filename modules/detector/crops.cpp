#include "modules/detector/crops.hpp"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

constexpr double kSharedRatio = 0.2;
constexpr double kBorder_px = 2.0;

}  // namespace

Crops make_crops(int width_px, int height_px, int num_crops) {
  const int side = std::min(width_px, height_px);
  const int spare = std::max(width_px, height_px) - side;
  if (num_crops == 0)
    num_crops = 1 + static_cast<int>(std::ceil(spare / ((1.0 - kSharedRatio) * side)));
  num_crops = std::clamp(num_crops, 1, static_cast<int>(kMaxCrops));
  Crops crops;
  for (int i = 0; i < num_crops; ++i) {
    const int offset = num_crops == 1 ? spare / 2 : spare * i / (num_crops - 1);
    const bool wide = width_px >= height_px;
    (void)crops.push_back({wide ? offset : 0, wide ? 0 : offset, side});
  }
  return crops;
}

bool is_cut_by(const Crop& crop, const Box& box, int width_px, int height_px) {
  const auto inner = [](int border, int image_border) { return border != image_border; };
  const int right = crop.left_px + crop.side_px;
  const int bottom = crop.top_px + crop.side_px;
  return (inner(crop.left_px, 0) && box.left_px < crop.left_px + kBorder_px) ||
         (inner(crop.top_px, 0) && box.top_px < crop.top_px + kBorder_px) ||
         (inner(right, width_px) && box.right_px > right - kBorder_px) ||
         (inner(bottom, height_px) && box.bottom_px > bottom - kBorder_px);
}

}  // namespace plumb
