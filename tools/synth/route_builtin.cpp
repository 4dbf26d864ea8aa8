#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tools/synth/random.hpp"
#include "tools/synth/route.hpp"

namespace plumb::synth {
namespace {

constexpr double kHalfTurn = 1.5707963267948966;

/// Draws a line by moving forward and turning, with speed limits and stops along it.
struct Pen {
  std::vector<Eigen::Vector3d> line{Eigen::Vector3d::Zero()};
  double yaw_rad = 0.0;
  double s_m = 0.0;

  void forward(double length_m, double curvature = 0.0) {
    const int steps = std::max(1, static_cast<int>(std::lround(length_m / 0.25)));
    const double ds = length_m / steps;
    for (int i = 0; i < steps; ++i) {
      yaw_rad += 0.5 * curvature * ds;
      line.push_back(line.back() + ds * Eigen::Vector3d(std::cos(yaw_rad), std::sin(yaw_rad), 0.0));
      yaw_rad += 0.5 * curvature * ds;
    }
    s_m += length_m;
  }
  void turn(double angle_rad, double radius_m) {
    forward(std::abs(angle_rad) * radius_m, (angle_rad > 0.0 ? 1.0 : -1.0) / radius_m);
  }
};

struct Stop {
  double s_m;
  double wait_s;
};

struct Pace {
  double cruise_m_s = 11.0;
  double accel_m_s2 = 1.6;
  double brake_m_s2 = 2.2;
  double lateral_m_s2 = 2.0;
  std::vector<Stop> stops;
};

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
    const double heading = random.uniform(0.0, 2.0 * kHalfTurn * 2.0);
    const double phase = random.uniform(0.0, 4.0 * kHalfTurn);
    const double weight = amplitude_m * 0.1 * std::pow(1.75, k);
    const Eigen::Vector2d wave =
        4.0 * kHalfTurn / wavelength * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    for (Eigen::Vector3d& p : line) p.z() += weight * std::sin(wave.dot(p.head<2>()) + phase);
  }
}

void draw_city(Pen& pen, double length_m, Random& random) {
  double side = random.chance(0.5) ? 1.0 : -1.0;
  pen.forward(random.uniform(55.0, 80.0));
  for (int k = 0; pen.s_m < length_m; ++k) {
    pen.turn(side * kHalfTurn, random.uniform(8.5, 12.0));
    if (k % 2 == 1) side = -side;  // left, left, right, right: no endless circling
    pen.forward(random.uniform(70.0, 120.0));
  }
}

void draw_loop(Pen& pen, double length_m, Random& random) {
  const double a = random.uniform(150.0, 190.0);
  const double b = random.uniform(70.0, 100.0);
  const double bend = 1.0 / random.uniform(110.0, 150.0);
  pen.forward(0.5 * a);
  for (int side = 0; pen.s_m < length_m; ++side) {
    pen.turn(kHalfTurn, side % 2 == 0 ? 10.0 : 14.0);
    const double length = side % 2 == 0 ? b : a;
    // An S-bend on each side returns to the same line, so that the loop closes.
    pen.forward(0.25 * length, side % 2 == 0 ? 0.0 : bend);
    pen.forward(0.5 * length, side % 2 == 0 ? 0.0 : -bend);
    pen.forward(0.25 * length, side % 2 == 0 ? 0.0 : bend);
  }
}

void draw_open(Pen& pen, double length_m, double radius_low_m, double radius_high_m,
               Random& random) {
  double side = 1.0;
  pen.forward(60.0);
  while (pen.s_m < length_m) {
    pen.turn(side * random.uniform(0.06, 0.22), random.uniform(radius_low_m, radius_high_m));
    pen.forward(random.uniform(30.0, 120.0));
    side = random.chance(0.7) ? -side : side;
  }
}

Setting motorway_setting() {
  Setting s;
  s.left_m = 9.4;
  s.right_m = 4.6;
  s.kerb_m = 0.0;
  s.sidewalk_m = 0.5;
  s.setback_m = 25.0;
  s.house_ratio = 0.06;
  s.tree_ratio = 0.5;
  s.parked_ratio = 0.0;
  s.dash_offset_m = 1.85;
  s.side_road_m = 0.0;
  s.hill_m = 2.5;
  s.roughness = 0.5;
  s.edge_lines = true;
  s.guard_rail = true;
  return s;
}

Setting main_road_setting() {
  Setting s;
  s.left_m = 5.4;
  s.right_m = 2.6;
  s.house_ratio = 0.45;
  s.tree_ratio = 0.5;
  s.parked_ratio = 0.12;
  s.edge_lines = true;
  s.side_road_m = 130.0;
  s.hill_m = 2.0;
  return s;
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& builtin_routes() {
  static const std::vector<std::pair<std::string, std::string>> list = {
      {"city", "residential streets with 90 degree turns, 8 to 12 m/s"},
      {"straight", "main road with gentle bends, slopes and crests, 14 m/s"},
      {"motorway", "three lanes, little texture beside the road, 27 m/s"},
      {"loop", "closed block of streets, returns to its start, 11 m/s"},
      {"stop-and-go", "main road in a queue: starts at rest, stops every 25 to 50 m"},
      {"stop", "main road at 8 m/s, one stop of 5 s after 24 m"},
      {"standing", "main road, at rest all the time"}};
  return list;
}

Route make_builtin_route(const std::string& name, double duration_s, std::uint64_t seed) {
  Route route;
  route.name = name;
  Random random(hash_keys(seed, 0x207e));
  Pen pen;
  Pace pace;
  double first_speed = 1.0;
  if (name == "city") {
    draw_city(pen, 12.0 * duration_s + 150.0, random);
  } else if (name == "loop") {
    draw_loop(pen, 12.0 * duration_s + 150.0, random);
  } else if (name == "straight") {
    route.setting = main_road_setting();
    pace.cruise_m_s = 14.0;
    draw_open(pen, 15.0 * duration_s + 100.0, 150.0, 400.0, random);
  } else if (name == "motorway") {
    route.setting = motorway_setting();
    pace.cruise_m_s = 27.0;
    draw_open(pen, 28.0 * duration_s + 100.0, 600.0, 1500.0, random);
  } else if (name == "stop-and-go") {
    route.setting = main_road_setting();
    pace.cruise_m_s = 8.0;
    first_speed = 0.0;
    pace.stops.push_back({0.0, 1.5});
    draw_open(pen, 9.0 * duration_s + 100.0, 150.0, 300.0, random);
    for (double s = 25.0; s < pen.s_m; s += random.uniform(25.0, 50.0))
      pace.stops.push_back({s, random.uniform(1.5, 3.5)});
  } else if (name == "stop") {
    route.setting = main_road_setting();
    pace.cruise_m_s = 8.0;
    pace.stops.push_back({24.0, 5.0});
    draw_open(pen, 9.0 * duration_s + 100.0, 150.0, 300.0, random);
  } else if (name == "standing") {
    route.setting = main_road_setting();
    pace.stops.push_back({0.0, duration_s + 10.0});
    draw_open(pen, 200.0, 150.0, 300.0, random);
  } else {
    throw std::invalid_argument("unknown route '" + name + "': --list-routes names them");
  }
  add_hills(pen.line, route.setting.hill_m, seed);
  resample(pen.line, 2.0, route);
  extend(route, 80.0, 350.0);
  route.start_m += 5.0;
  add_side_roads(route, seed);
  make_schedule(route, pace, duration_s, first_speed);
  return route;
}

}  // namespace plumb::synth
