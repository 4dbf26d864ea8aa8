/// The stretch of road that RoadMotion looks at, as a grid seen from above.
///
/// Units:
///   Heights of the camera above the road, so that no metric height is needed.
/// Layout:
///   Row i lies kNearestRoad + i kRoadRowStep ahead, column j lies (j - (kNumRoadColumns - 1) / 2)
///   kRoadColumnStep to the right.
#pragma once

#include <array>
#include <cstddef>

#include "core/simd.hpp"

namespace plumb::vo {

inline constexpr std::size_t kNumRoadRows = 200;
inline constexpr std::size_t kNumRoadColumns = 40;
static_assert(kNumRoadColumns % kNumLanes == 0);

inline constexpr double kNearestRoad = 4.0;
inline constexpr double kRoadRowStep = 0.085;
inline constexpr double kRoadColumnStep = 0.125;

/// One number per cell, row by row.
using RoadGrid = std::array<float, kNumRoadRows * kNumRoadColumns>;

/// Distance of a row.
[[nodiscard]] constexpr double row_distance(double row) {
  return kNearestRoad + kRoadRowStep * row;
}

}  // namespace plumb::vo
