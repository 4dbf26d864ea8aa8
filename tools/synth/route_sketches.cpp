#include "tools/synth/sketch.hpp"

namespace plumb::synth {
namespace {

constexpr double kRightAngle = 1.5707963267948966;

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
  s.dash_period_m = 18.0;
  s.dash_m = 6.0;
  s.lanes_left = 2;
  s.left_line_m = 0.6;
  s.right_line_m = 2.1;
  s.side_road_m = 0.0;
  s.hill_m = 2.5;
  s.roughness = 0.5;
  s.edge_lines = true;
  s.guard_rail = true;
  return s;
}

/// Concrete slabs and American marks; ours is the second of four lanes from the right.
Setting freeway_setting() {
  Setting s = motorway_setting();
  s.left_m = 11.0;
  s.right_m = 8.3;
  s.dash_period_m = 14.63;
  s.dash_m = 3.66;
  s.lanes_right = 1;
  s.right_line_m = 5.65;
  s.slab_m = 4.6;
  s.tree_ratio = 0.35;
  s.house_ratio = 0.15;
  s.barrier = true;
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

/// Our lane, a lane with a tram's track beside it, and one for oncoming traffic.
Setting inner_city_setting() {
  Setting s;
  s.left_m = 9.2;
  s.right_m = 2.5;
  s.lane_m = 3.4;
  s.lanes_left = 1;
  s.oncoming_m = 6.9;
  s.tram_m = 3.4;
  s.sidewalk_m = 3.2;
  s.setback_m = 3.4;
  s.house_ratio = 0.97;
  s.tree_ratio = 0.15;
  s.parked_ratio = 0.6;
  s.dash_offset_m = 1.7;
  s.side_road_m = 75.0;
  s.hill_m = 0.6;
  return s;
}

void draw_city(Sketch& k) {
  const double length_m = 12.0 * k.duration_s + 150.0;
  double side = k.random.chance(0.5) ? 1.0 : -1.0;
  k.pen.forward(k.random.uniform(55.0, 80.0));
  for (int n = 0; k.pen.s_m < length_m; ++n) {
    k.pen.turn(side * kRightAngle, k.random.uniform(8.5, 12.0));
    if (n % 2 == 1) side = -side;  // left, left, right, right: no endless circling
    k.pen.forward(k.random.uniform(70.0, 120.0));
  }
}

void draw_loop(Sketch& k) {
  const double length_m = 12.0 * k.duration_s + 150.0;
  const double a = k.random.uniform(150.0, 190.0);
  const double b = k.random.uniform(70.0, 100.0);
  const double bend = 1.0 / k.random.uniform(110.0, 150.0);
  k.pen.forward(0.5 * a);
  for (int side = 0; k.pen.s_m < length_m; ++side) {
    k.pen.turn(kRightAngle, side % 2 == 0 ? 10.0 : 14.0);
    const double length = side % 2 == 0 ? b : a;
    // An S-bend on each side returns to the same line, so that the loop closes.
    k.pen.forward(0.25 * length, side % 2 == 0 ? 0.0 : bend);
    k.pen.forward(0.5 * length, side % 2 == 0 ? 0.0 : -bend);
    k.pen.forward(0.25 * length, side % 2 == 0 ? 0.0 : bend);
  }
}

void draw_open(Sketch& k, double length_m, double radius_low_m, double radius_high_m) {
  double side = 1.0;
  k.pen.forward(60.0);
  while (k.pen.s_m < length_m) {
    k.pen.turn(side * k.random.uniform(0.06, 0.22), k.random.uniform(radius_low_m, radius_high_m));
    k.pen.forward(k.random.uniform(30.0, 120.0));
    side = k.random.chance(0.7) ? -side : side;
  }
}

void draw_straight(Sketch& k) {
  k.setting = main_road_setting();
  k.pace.cruise_m_s = 14.0;
  draw_open(k, 15.0 * k.duration_s + 100.0, 150.0, 400.0);
}

void draw_motorway(Sketch& k) {
  k.setting = motorway_setting();
  k.pace.cruise_m_s = 27.0;
  draw_open(k, 28.0 * k.duration_s + 100.0, 600.0, 1500.0);
}

void draw_freeway(Sketch& k) {
  k.setting = freeway_setting();
  k.pace.cruise_m_s = 27.0;
  draw_open(k, 28.0 * k.duration_s + 100.0, 900.0, 2000.0);
}

void draw_stop_and_go(Sketch& k) {
  k.setting = main_road_setting();
  k.pace.cruise_m_s = 8.0;
  k.first_speed_m_s = 0.0;
  k.pace.stops.push_back({0.0, 1.5});
  draw_open(k, 9.0 * k.duration_s + 100.0, 150.0, 300.0);
  for (double s = 25.0; s < k.pen.s_m; s += k.random.uniform(25.0, 50.0))
    k.pace.stops.push_back({s, k.random.uniform(1.5, 3.5)});
}

/// Stop and go on the freeway: faster than in a queue in town, and with lanes on both sides.
void draw_jam(Sketch& k) {
  k.setting = freeway_setting();
  k.pace.cruise_m_s = 10.0;
  k.pace.accel_m_s2 = 1.2;
  draw_open(k, 11.0 * k.duration_s + 100.0, 900.0, 2000.0);
  for (double s = 45.0; s < k.pen.s_m; s += k.random.uniform(50.0, 90.0))
    k.pace.stops.push_back({s, k.random.uniform(1.5, 3.5)});
}

void draw_stop(Sketch& k) {
  k.setting = main_road_setting();
  k.pace.cruise_m_s = 8.0;
  k.pace.stops.push_back({24.0, 5.0});
  draw_open(k, 9.0 * k.duration_s + 100.0, 150.0, 300.0);
}

void draw_standing(Sketch& k) {
  k.setting = main_road_setting();
  k.pace.stops.push_back({0.0, k.duration_s + 10.0});
  draw_open(k, 200.0, 150.0, 300.0);
}

/// Roundabouts, entered and left to the right; straight on and to the left by turns.
void draw_roundabout(Sketch& k) {
  k.setting.side_road_m = 60.0;
  k.setting.house_ratio = 0.5;
  constexpr double kDeflection = 0.9;  // [rad]
  k.pen.forward(k.random.uniform(30.0, 45.0));
  for (int n = 0; k.pen.s_m < 12.0 * k.duration_s + 150.0; ++n) {
    const double exit_rad = n % 2 == 0 ? 0.0 : kRightAngle;
    k.pen.turn(-kDeflection, k.random.uniform(16.0, 20.0));
    k.pen.turn(2.0 * kDeflection + exit_rad, k.random.uniform(14.0, 18.0));
    k.pen.turn(-kDeflection, k.random.uniform(18.0, 24.0));
    k.pen.forward(k.random.uniform(50.0, 80.0));
  }
}

void draw_inner_city(Sketch& k) {
  k.setting = inner_city_setting();
  k.pace.cruise_m_s = 9.0;
  draw_open(k, 10.0 * k.duration_s + 100.0, 90.0, 250.0);
  for (double s = k.random.uniform(60.0, 90.0); s < k.pen.s_m; s += k.random.uniform(70.0, 130.0))
    k.pace.stops.push_back({s, k.random.uniform(1.5, 3.0)});
}

}  // namespace

const std::vector<BuiltinRoute>& route_sketches() {
  static const std::vector<BuiltinRoute> list = {
      {"city", "residential streets with 90 degree turns, 8 to 12 m/s", draw_city},
      {"straight", "main road with gentle bends, slopes and crests, 14 m/s", draw_straight},
      {"motorway", "three lanes, little texture beside the road, 27 m/s", draw_motorway},
      {"loop", "closed block of streets, returns to its start, 11 m/s", draw_loop},
      {"stop-and-go", "main road in a queue: starts at rest, stops every 25 to 50 m",
       draw_stop_and_go},
      {"stop", "main road at 8 m/s, one stop of 5 s after 24 m", draw_stop},
      {"standing", "main road, at rest all the time", draw_standing},
      {"freeway", "four lanes of concrete, ours the second from the right, 27 m/s", draw_freeway},
      {"jam", "the same road, up to 10 m/s, a stop every 50 to 90 m", draw_jam},
      {"roundabout", "streets from one roundabout to the next, 5 to 11 m/s", draw_roundabout},
      {"inner-city", "narrow street with a tram's track, 9 m/s, stops every 70 to 130 m",
       draw_inner_city}};
  return list;
}

}  // namespace plumb::synth
