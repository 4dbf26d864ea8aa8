/// How well the road of two images agrees, for every shift along the road.
///
/// Far rows and near rows are kept apart. An error e of the camera's pitch stretches the distances
/// of a flat road: at the distance X the road seems to be 1 + 2 e X times as fast (heights of the
/// camera), so that the zones tell pitch and speed apart.
///
/// Memory:
///   In place.
#pragma once

#include <array>
#include <cstddef>

#include "modules/vo/road/road_grid.hpp"

namespace plumb::vo {

inline constexpr std::size_t kNumZones = 5;
/// First row of each zone, and the end of the last one.
inline constexpr std::array<std::size_t, kNumZones + 1> kZoneRows{0, 18, 42, 71, 112, kNumRoadRows};
/// Fewer rows than these do not show a shift.
inline constexpr std::size_t kLeastRoadOverlap = 45;
inline constexpr std::size_t kNumShifts = kNumRoadRows - kLeastRoadOverlap + 1;

/// Distance of the middle of a zone.
[[nodiscard]] constexpr double zone_distance(std::size_t zone) {
  return row_distance(0.5 * static_cast<double>(kZoneRows[zone] + kZoneRows[zone + 1] - 1));
}

/// Sums over the cells of a zone and their partners in the older image.
struct Agreement {
  double product = 0.0;
  double now = 0.0;     ///< squares of the newer image
  double before = 0.0;  ///< squares of the older image
};

class RoadShifts {
 public:
  /// Compares row i of `now` with row i + shift of `before`, for all shifts.
  void compare(const RoadGrid& now, const RoadGrid& before);

  /// Sums of a zone at a shift between whole rows; zeros beyond the largest shift.
  [[nodiscard]] Agreement at(std::size_t zone, double shift_rows) const;

 private:
  std::array<std::array<Agreement, kNumShifts>, kNumZones> zones_{};
};

}  // namespace plumb::vo
