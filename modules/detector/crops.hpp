/// Divides a wide image into overlapping squares. A network with a square input then sees small
/// objects at a larger scale than in the whole image.
///
/// Frames:
///   Crops are in pixels of the image.
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

/// Places `num_crops` squares evenly along the longer side. When `num_crops` is 0, as many are
/// placed as make neighbours overlap by a fifth.
/// @pre sizes above 0
[[nodiscard]] Crops make_crops(int width_px, int height_px, int num_crops);

/// True when a border of `crop` inside the image cuts `box`.
/// The neighbouring crop then sees all of it.
[[nodiscard]] bool is_cut_by(const Crop& crop, const Box& box, int width_px, int height_px);

}  // namespace plumb
