#include "tools/synth/route.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/synth/random.hpp"

namespace plumb::synth {
namespace {

double wrap_angle(double a) { return std::remainder(a, 2.0 * std::numbers::pi); }

/// Fills heading and curvature of all points by differences of their positions.
void derive_heading(std::vector<RoutePoint>& points) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d& a = points[i > 0 ? i - 1 : 0].p_map;
    const Eigen::Vector2d& b = points[std::min(i + 1, n - 1)].p_map;
    points[i].yaw_rad = std::atan2(b.y() - a.y(), b.x() - a.x());
    points[i].along = (b - a).normalized();
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    points[i].curvature =
        wrap_angle(points[i + 1].yaw_rad - points[i - 1].yaw_rad) / (2.0 * Route::kStep);
  }
}

/// Resamples a polyline at equal distances in plan.
std::vector<Eigen::Vector3d> equal_steps(const std::vector<Eigen::Vector3d>& line, double step_m) {
  std::vector<Eigen::Vector3d> out{line.front()};
  double carried = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double length = (line[i] - line[i - 1]).head<2>().norm();
    double at = step_m - carried;
    for (; at <= length; at += step_m)
      out.push_back(line[i - 1] + (line[i] - line[i - 1]) * (at / length));
    carried = length - (at - step_m);
  }
  return out;
}

bool runs_along(const Route& route, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d direction = (to - from).normalized();
  const double length = (to - from).norm();
  for (std::size_t i = 0; i < route.points.size(); i += 4) {
    const RoutePoint& point = route.points[i];
    const Eigen::Vector2d d = point.p_map - from;
    const double along = d.dot(direction);
    if (along < 12.0 || along > length + 10.0) continue;
    const double across = std::abs(direction.x() * d.y() - direction.y() * d.x());
    const double parallel =
        std::abs(std::cos(point.yaw_rad) * direction.x() + std::sin(point.yaw_rad) * direction.y());
    if (across < 14.0 && parallel > 0.7) return true;
  }
  return false;
}

}  // namespace

RoutePoint Route::at(double s_m) const {
  const double x = std::clamp(s_m / kStep, 0.0, static_cast<double>(points.size() - 1) - 1e-9);
  const auto i = static_cast<std::size_t>(x);
  const double f = x - static_cast<double>(i);
  const RoutePoint& a = points[i];
  const RoutePoint& b = points[i + 1];
  // Hermite interpolation keeps the heading continuous. Otherwise a smooth drive would show a kink
  // every half metre.
  const Eigen::Vector2d chord = b.p_map - a.p_map;
  const double dyaw = wrap_angle(b.yaw_rad - a.yaw_rad);
  const Eigen::Vector2d ta = kStep * Eigen::Vector2d(std::cos(a.yaw_rad), std::sin(a.yaw_rad));
  const Eigen::Vector2d tb = kStep * Eigen::Vector2d(std::cos(b.yaw_rad), std::sin(b.yaw_rad));
  const double f2 = f * f;
  const double f3 = f2 * f;
  RoutePoint out;
  out.p_map = a.p_map + (3.0 * f2 - 2.0 * f3) * chord + (f3 - 2.0 * f2 + f) * ta + (f3 - f2) * tb;
  out.z_m = a.z_m + f * (b.z_m - a.z_m);
  out.yaw_rad = a.yaw_rad + f * dyaw;
  out.curvature = a.curvature + f * (b.curvature - a.curvature);
  return out;
}

void smooth_samples(std::vector<double>& values, double sigma_samples) {
  if (sigma_samples <= 0.0 || values.size() < 2) return;
  const int radius = static_cast<int>(std::ceil(3.0 * sigma_samples));
  std::vector<double> kernel;
  double total = 0.0;
  for (int k = -radius; k <= radius; ++k) {
    kernel.push_back(std::exp(-0.5 * k * k / (sigma_samples * sigma_samples)));
    total += kernel.back();
  }
  const int n = static_cast<int>(values.size());
  const auto value = [&](int i) {  // mirrored at the end points, so that a steady slope stays one
    if (i < 0) return 2.0 * values.front() - values[static_cast<std::size_t>(std::min(-i, n - 1))];
    if (i >= n)
      return 2.0 * values.back() - values[static_cast<std::size_t>(std::max(2 * (n - 1) - i, 0))];
    return values[static_cast<std::size_t>(i)];
  };
  std::vector<double> padded;
  for (int i = -radius; i < n + radius; ++i) padded.push_back(value(i));
  for (int i = 0; i < n; ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < kernel.size(); ++k)
      sum += kernel[k] * padded[static_cast<std::size_t>(i) + k];
    values[static_cast<std::size_t>(i)] = sum / total;
  }
}

void resample(const std::vector<Eigen::Vector3d>& polyline, double smoothing_m, Route& route) {
  std::vector<Eigen::Vector3d> line = equal_steps(polyline, Route::kStep);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& p : line) values.push_back(p[axis]);
    smooth_samples(values, smoothing_m / Route::kStep);
    for (std::size_t i = 0; i < line.size(); ++i) line[i][axis] = values[i];
  }
  line = equal_steps(line, Route::kStep);
  route.points.assign(line.size(), RoutePoint{});
  for (std::size_t i = 0; i < line.size(); ++i) {
    route.points[i].p_map = line[i].head<2>();
    route.points[i].z_m = line[i].z();
  }
  derive_heading(route.points);
}

void extend(Route& route, double before_m, double after_m) {
  const auto straight = [](const RoutePoint& from, double ds) {
    RoutePoint p = from;
    p.p_map += ds * Eigen::Vector2d(std::cos(from.yaw_rad), std::sin(from.yaw_rad));
    p.curvature = 0.0;
    return p;
  };
  const int before = static_cast<int>(before_m / Route::kStep);
  const int after = static_cast<int>(after_m / Route::kStep);
  std::vector<RoutePoint> points;
  for (int i = before; i > 0; --i)
    points.push_back(straight(route.points.front(), -i * Route::kStep));
  points.insert(points.end(), route.points.begin(), route.points.end());
  for (int i = 1; i <= after; ++i)
    points.push_back(straight(route.points.back(), i * Route::kStep));
  route.points = std::move(points);
  route.start_m += before * Route::kStep;
}

void add_side_roads(Route& route, std::uint64_t seed) {
  const double spacing = route.setting.side_road_m;
  if (spacing <= 0.0) return;
  Random random(hash_keys(seed, 0x51de));
  for (double s = 20.0; s < route.length_m() - 20.0; s += spacing * random.uniform(0.6, 1.4)) {
    const RoutePoint p = route.at(s);
    if (std::abs(p.curvature) > 0.02) continue;
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    const double yaw = p.yaw_rad + side * random.uniform(1.35, 1.8);
    const Eigen::Vector2d to = p.p_map + 75.0 * Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
    if (runs_along(route, p.p_map, to)) continue;
    route.side_roads.push_back({p.p_map, to, random.uniform(2.5, 3.2)});
  }
}

}  // namespace plumb::synth
