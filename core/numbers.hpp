/// Numbers and conversions that several modules share.
#pragma once

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

}  // namespace plumb
