/// The ground: a smooth height field with the road's crown, and the distance of each place from the
/// road.
///
/// Frames:
///   map: x east, y north, z up, metres.
/// Rays:
///   o + t d with d of any length; t counts in lengths of d.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "tools/synth/route.hpp"

namespace plumb::synth {

/// A place in road coordinates.
struct RoadCoordinate {
  bool valid = false;
  double s_m = 0.0;                                  ///< along the driven lane
  double d_m = 0.0;                                  ///< to the left of its centre
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< direction of the lane
};

class Terrain {
 public:
  static constexpr float kFar = 1e3F;

  explicit Terrain(const Route& route);

  /// Height of the road surface (crown and bumps included) or of the land where there is no road.
  [[nodiscard]] double height(double x, double y) const;

  /// Height without crown and bumps: cheaper, at most kCrown lower.
  [[nodiscard]] double base_height(double x, double y) const;

  /// Height of crown and bumps above base_height(). `edge_m` is edge_distance(x, y).
  [[nodiscard]] double relief(double x, double y, double edge_m) const;

  /// Signed distance to the nearest road edge, negative on the road, up to kFar.
  [[nodiscard]] double edge_distance(double x, double y) const;

  [[nodiscard]] RoadCoordinate road_coordinate(double x, double y) const;

  /// Upward unit normal.
  [[nodiscard]] Eigen::Vector3d normal(double x, double y) const;

  [[nodiscard]] const Route& route() const { return *route_; }

  static constexpr double kCrown = 0.05;  ///< [m] the middle of the road above its edges

 private:
  struct Cell {
    float edge_main = kFar;
    float edge_side = kFar;
    std::int32_t nearest = -1;
    float along = kFar;
  };
  struct PlacedBump {
    Eigen::Vector2d centre;
    Eigen::Vector2d along;
    double height_m;
    double half_length_m;
    double half_width_m;
  };

  void build_heights();
  void build_edges();
  void stamp_point(std::size_t index);
  void stamp_side_road(const SideRoad& road);
  Cell* cell_at(int cx, int cy);
  [[nodiscard]] const Cell* find_cell(int cx, int cy) const;
  [[nodiscard]] double bump_height(double x, double y) const;

  const Route* route_;
  Eigen::Vector2d origin_;
  int height_nx_ = 0;
  int height_ny_ = 0;
  std::vector<float> heights_;
  int block_nx_ = 0;
  int block_ny_ = 0;
  std::vector<std::int32_t> block_of_;
  std::vector<Cell> cells_;
  std::vector<PlacedBump> bumps_;
};

}  // namespace plumb::synth
