/// The route of a drive: centre of the driven lane, cross-section of the road, and the distance
/// along the route at each time.
///
/// Frames:
///   map: x east, y north, z up, metres. Lateral offsets count to the left of the direction
///   of travel.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace plumb::synth {

/// The road's cross-section and how much stands beside it.
struct Setting {
  double left_m = 4.6;          ///< road edge to the left of the driven lane's centre
  double right_m = 2.7;         ///< road edge to the right
  double kerb_m = 0.12;         ///< height of the kerb; 0 = flush shoulder
  double sidewalk_m = 2.2;      ///< paved width beside the road
  double setback_m = 5.0;       ///< nearest wall to the road edge
  double house_ratio = 0.85;    ///< share of plots with a house
  double tree_ratio = 0.5;      ///< share of tree places taken
  double parked_ratio = 0.35;   ///< share of parking places taken
  double dash_offset_m = 1.75;  ///< lane line to the left of the lane's centre; 0 = none
  double dash_period_m = 9.0;   ///< from the beginning of a dash to that of the next
  double dash_m = 3.0;          ///< length of a dash
  double lane_m = 3.7;          ///< width of the lanes beside ours
  int lanes_left = 0;           ///< lanes of our direction to the left of ours
  int lanes_right = 0;          ///< and to the right
  double side_road_m = 90.0;    ///< mean distance between side roads; 0 = none
  double hill_m = 1.5;          ///< amplitude of the terrain
  double roughness = 1.0;       ///< 1 = ISO 8608 class B
  double oncoming_m = 3.4;      ///< lane of oncoming traffic, to the left of ours
  double left_line_m = 0.35;    ///< from the road's left edge to its edge line
  double right_line_m = 0.0;    ///< our lane's centre to the right edge line; 0 = 0.35 m inside
  double slab_m = 0.0;          ///< concrete slabs: distance between joints; 0 = asphalt
  double tram_m = 0.0;          ///< middle of a tram's track to the left of the lane; 0 = none
  bool edge_lines = false;
  bool guard_rail = false;
  bool barrier = false;  ///< a concrete wall to the left and overhead signs, as on a freeway
};

struct RoutePoint {
  Eigen::Vector2d p_map = Eigen::Vector2d::Zero();
  double z_m = 0.0;
  double yaw_rad = 0.0;
  double curvature = 0.0;                            ///< [1/m], left positive
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< unit vector of the heading
};

/// A straight road that joins but is not driven.
struct SideRoad {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double half_width_m = 2.8;
};

/// A bump across the road.
struct Bump {
  double s_m = 0.0;
  double height_m = 0.08;
  double half_length_m = 1.8;
};

/// Distance along the route at a time, sampled every kTimeStep.
struct Schedule {
  static constexpr double kTimeStep = 0.002;
  std::vector<double> s_m;
};

struct Route {
  static constexpr double kStep = 0.5;  ///< [m] between points

  std::string name;
  Setting setting;
  std::vector<RoutePoint> points;
  double start_m = 0.0;  ///< where along the points the drive begins
  Schedule schedule;
  std::vector<SideRoad> side_roads;
  std::vector<Bump> bumps;
  bool flat = false;

  [[nodiscard]] double length_m() const { return kStep * static_cast<double>(points.size() - 1); }
  /// Point at a distance along the route, clamped to its ends.
  [[nodiscard]] RoutePoint at(double s_m) const;
};

/// Name and one-line description of each built-in route.
[[nodiscard]] const std::vector<std::pair<std::string, std::string>>& builtin_routes();

/// A built-in route long enough for `duration_s`. Throws std::invalid_argument for an unknown name.
[[nodiscard]] Route make_builtin_route(const std::string& name, double duration_s,
                                       std::uint64_t seed);

/// The route along KITTI pose rows [first, last] taken every 1 / source_rate_hz seconds.
/// `camera_ahead_m` is the camera's place before the rear axle. Throws std::invalid_argument,
/// naming the file and line, for what cannot be read.
[[nodiscard]] Route make_pose_route(const std::filesystem::path& file, int first, int last,
                                    double source_rate_hz, double camera_ahead_m,
                                    std::uint64_t seed);

/// Fills the route with points every kStep along a polyline. Heading and curvature are those of its
/// smoothed shape.
void resample(const std::vector<Eigen::Vector3d>& polyline, double smoothing_m, Route& route);

/// Continues the route straight on at both ends, so that there is a road to see.
void extend(Route& route, double before_m, double after_m);

/// Side roads at random places, never where they would run along the route.
void add_side_roads(Route& route, std::uint64_t seed);

/// Gaussian smoothing in place; the ends stay where they are and steady slopes stay steady.
void smooth_samples(std::vector<double>& values, double sigma_samples);

}  // namespace plumb::synth
