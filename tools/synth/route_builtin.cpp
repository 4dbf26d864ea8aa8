#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tools/synth/random.hpp"
#include "tools/synth/route.hpp"
#include "tools/synth/sketch.hpp"

namespace plumb::synth {
namespace {

constexpr double kQuarterTurn = 1.5707963267948966;

/// Highest speed at each point: cruise, lateral acceleration, and what braking for the next limit
/// allows.
std::vector<double> speed_limits(const Route& route, const Pace& pace) {
  std::vector<double> v;
  for (const RoutePoint& p : route.points) {
    v.push_back(std::min(pace.cruise_m_s,
                         std::sqrt(pace.lateral_m_s2 / std::max(1e-6, std::abs(p.curvature)))));
  }
  for (const Stop& stop : pace.stops) {
    const auto i = static_cast<std::size_t>((route.start_m + stop.s_m) / Route::kStep);
    if (i < v.size()) v[i] = 0.0;
  }
  for (std::size_t i = v.size() - 1; i-- > 0;) {
    v[i] = std::min(v[i], std::sqrt(v[i + 1] * v[i + 1] + 2.0 * pace.brake_m_s2 * Route::kStep));
  }
  for (std::size_t i = 1; i < v.size(); ++i) {
    v[i] = std::min(v[i], std::sqrt(v[i - 1] * v[i - 1] + 2.0 * pace.accel_m_s2 * Route::kStep));
  }
  return v;
}

/// Makes the schedule of a drive at the limits of speed that waits at stops. Smoothing over time
/// limits the jerk.
void make_schedule(Route& route, const Pace& pace, double duration_s, double first_speed_m_s) {
  std::vector<double> limits = speed_limits(route, pace);
  const auto first = static_cast<std::size_t>(route.start_m / Route::kStep);
  for (std::size_t i = first + 1; first_speed_m_s <= 0.0 && i < limits.size(); ++i) {
    const double run_up =
        std::sqrt(2.0 * pace.accel_m_s2 * static_cast<double>(i - first) * Route::kStep);
    limits[i] = std::min(limits[i], run_up);
  }
  std::vector<double>& s = route.schedule.s_m;
  const auto samples =
      static_cast<std::size_t>(std::ceil((duration_s + 1.0) / Schedule::kTimeStep));
  double at = route.start_m;
  double waited_s = 0.0;
  std::size_t next_stop = 0;
  while (s.size() < samples) {
    s.push_back(at);
    if (next_stop < pace.stops.size() && at >= route.start_m + pace.stops[next_stop].s_m - 0.05) {
      waited_s += Schedule::kTimeStep;
      if (waited_s < pace.stops[next_stop].wait_s) continue;
      waited_s = 0.0;
      ++next_stop;
    }
    const double x = std::min(at / Route::kStep, static_cast<double>(limits.size()) - 1.001);
    const auto i = static_cast<std::size_t>(x);
    const double v = limits[i] + (x - static_cast<double>(i)) * (limits[i + 1] - limits[i]);
    at += std::max(v, 0.1) * Schedule::kTimeStep;
  }
  smooth_samples(s, 0.3 / Schedule::kTimeStep);
}

/// Hills as a function of the place, so that a route that returns finds the same height.
void add_hills(std::vector<Eigen::Vector3d>& line, double amplitude_m, std::uint64_t seed) {
  Random random(hash_keys(seed, 0x4111));
  for (int k = 0; k < 6; ++k) {
    const double wavelength = 130.0 * std::pow(1.6, k);
    const double heading = random.uniform(0.0, 2.0 * kQuarterTurn * 2.0);
    const double phase = random.uniform(0.0, 4.0 * kQuarterTurn);
    const double weight = amplitude_m * 0.1 * std::pow(1.75, k);
    const Eigen::Vector2d wave =
        4.0 * kQuarterTurn / wavelength * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    for (Eigen::Vector3d& p : line) p.z() += weight * std::sin(wave.dot(p.head<2>()) + phase);
  }
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& builtin_routes() {
  static const std::vector<std::pair<std::string, std::string>> list = [] {
    std::vector<std::pair<std::string, std::string>> names;
    for (const BuiltinRoute& route : route_sketches()) names.emplace_back(route.name, route.text);
    return names;
  }();
  return list;
}

Route make_builtin_route(const std::string& name, double duration_s, std::uint64_t seed) {
  const std::vector<BuiltinRoute>& sketches = route_sketches();
  const auto found = std::find_if(sketches.begin(), sketches.end(),
                                  [&](const BuiltinRoute& route) { return route.name == name; });
  if (found == sketches.end())
    throw std::invalid_argument("unknown route '" + name + "': --list-routes names them");
  Sketch sketch{duration_s, Random(hash_keys(seed, 0x207e)), {}, {}, {}};
  found->draw(sketch);
  Route route;
  route.name = name;
  route.setting = sketch.setting;
  add_hills(sketch.pen.line, route.setting.hill_m, seed);
  resample(sketch.pen.line, 2.0, route);
  extend(route, 80.0, 350.0);
  route.start_m += 5.0;
  add_side_roads(route, seed);
  make_schedule(route, sketch.pace, duration_s, sketch.first_speed_m_s);
  return route;
}

}  // namespace plumb::synth
