/// How built-in routes are drawn: a pen for the line, and a pace along it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/synth/random.hpp"
#include "tools/synth/route.hpp"

namespace plumb::synth {

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

/// What a sketch of a route fills in.
struct Sketch {
  double duration_s;
  Random random;
  Pen pen;
  Pace pace;
  Setting setting;
  double first_speed_m_s = 1.0;  ///< 0 = from rest
};

/// A built-in route: its name, one line about it, and how it is drawn.
struct BuiltinRoute {
  const char* name;
  const char* text;
  void (*draw)(Sketch& sketch);
};

[[nodiscard]] const std::vector<BuiltinRoute>& route_sketches();

}  // namespace plumb::synth
