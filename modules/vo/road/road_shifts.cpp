#include "modules/vo/road/road_shifts.hpp"

#include <algorithm>

namespace plumb::vo {
namespace {

using RowSums = std::array<double, kNumRoadRows + 1>;  // sums of the rows before each row

float row_product(const float* a, const float* b) {
  Float8 sum = load_floats(a) * load_floats(b);
  for (std::size_t i = kNumLanes; i < kNumRoadColumns; i += kNumLanes)
    sum += load_floats(a + i) * load_floats(b + i);
  return sum_float(sum);
}

RowSums squares_before(const RoadGrid& grid) {
  RowSums sums{};
  for (std::size_t row = 0; row < kNumRoadRows; ++row) {
    const float* cells = &grid[row * kNumRoadColumns];
    sums[row + 1] = sums[row] + static_cast<double>(row_product(cells, cells));
  }
  return sums;
}

}  // namespace

void RoadShifts::compare(const RoadGrid& now, const RoadGrid& before) {
  const RowSums now_squares = squares_before(now);
  const RowSums before_squares = squares_before(before);
  for (std::size_t shift = 0; shift < kNumShifts; ++shift) {
    const std::size_t end = kNumRoadRows - shift;
    for (std::size_t zone = 0; zone < kNumZones; ++zone) {
      const std::size_t first = std::min(kZoneRows[zone], end);
      const std::size_t last = std::min(kZoneRows[zone + 1], end);
      Agreement& sums = zones_[zone][shift];
      sums.product = 0.0;
      for (std::size_t row = first; row < last; ++row) {
        sums.product += static_cast<double>(
            row_product(&now[row * kNumRoadColumns], &before[(row + shift) * kNumRoadColumns]));
      }
      sums.now = now_squares[last] - now_squares[first];
      sums.before = before_squares[last + shift] - before_squares[first + shift];
    }
  }
}

Agreement RoadShifts::at(std::size_t zone, double shift_rows) const {
  if (!(shift_rows >= 0.0) || shift_rows >= static_cast<double>(kNumShifts - 1)) return {};
  const auto whole = static_cast<std::size_t>(shift_rows);
  const double part = shift_rows - static_cast<double>(whole);
  const Agreement& low = zones_[zone][whole];
  const Agreement& high = zones_[zone][whole + 1];
  return {low.product + part * (high.product - low.product), low.now + part * (high.now - low.now),
          low.before + part * (high.before - low.before)};
}

}  // namespace plumb::vo
