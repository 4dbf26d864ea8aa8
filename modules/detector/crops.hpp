/// Squares cut out of a wide image, so that a network that takes squares sees small objects at their size.
#pragma once

#include <cstddef>

#include "core/fixed_vector.hpp"
#include "modules/detections/detection.hpp"

namespace plumb {

inline constexpr std::size_t kMaxCrops = 8;

struct Crop {
  int left_px = 0;
  int top_px = 0;
  int side_px = 0;
};
using Crops = FixedVector<Crop, kMaxCrops>;

/// `num_crops` squares, evenly over the longer side; 0: as many as it takes for neighbours to share a fifth.
/// @pre sizes above 0
[[nodiscard]] Crops make_crops(int width_px, int height_px, int num_crops);

/// Whether a border of `crop` that is none of the image's cuts `box` (image pixels): the neighbour sees it whole.
[[nodiscard]] bool is_cut_by(const Crop& crop, const Box& box, int width_px, int height_px);

}  // namespace plumb
