/// Numbers and conversions that several modules share.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

namespace plumb {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();
/// One degree [rad].
inline constexpr double kDegree = std::numbers::pi / 180.0;

/// Converts radians to degrees.
constexpr double degrees(double rad) { return rad * 180.0 / std::numbers::pi; }

constexpr double square(double x) { return x * x; }

/// Square root of the sum of squares, with the same bits on every processor. std::hypot rounds
/// differently where the processor has a fused multiplication.
inline double root_sum_square(double a, double b, double c = 0.0) {
  return std::sqrt(a * a + b * b + c * c);
}

}  // namespace plumb
