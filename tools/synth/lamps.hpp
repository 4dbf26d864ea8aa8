/// Artificial light: headlights, street lamps and the lamps of a tunnel.
///
/// Frames:
///   map
/// Units:
///   A lamp of strength 1 lights a sheet that faces it at a distance of 1 m as a light of strength
///   1 does (surface.hpp).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/se3.hpp"
#include "tools/synth/surface.hpp"
#include "tools/synth/terrain.hpp"

namespace plumb::synth {

/// A lamp that shines downwards.
struct Lamp {
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();
  double strength = 1.0;
};

/// A stretch of the route under a roof; empty when `to_m` is not beyond `from_m`.
struct Tube {
  double from_m = 0.0;  ///< along the route
  double to_m = 0.0;

  [[nodiscard]] bool empty() const { return to_m <= from_m; }
};

inline constexpr double kTubeWall = 1.3;    ///< [m] from the road's edge to the wall
inline constexpr double kTubeHeight = 5.6;  ///< [m]

class Lamps {
 public:
  /// `night` switches the lamps of vehicles on.
  Lamps(const Terrain& terrain, const Tube& tube, std::vector<Lamp> lamps, bool night);

  [[nodiscard]] bool night() const { return night_; }
  [[nodiscard]] bool lit() const { return night_ || !lamps_.empty(); }

  /// Light that a surface sends towards the viewer, without that of sun and sky. Headlights shine
  /// from the vehicle's pose.
  [[nodiscard]] float answer(const Reflectance& surface, const Patch& patch,
                             const Se3& T_map_veh) const;

  /// Share of the sky's light that reaches a place: less in the tube.
  [[nodiscard]] float sky_share(const Eigen::Vector3d& p_map) const;

 private:
  [[nodiscard]] double headlights(const Reflectance& surface, const Patch& patch,
                                  const Se3& T_map_veh) const;
  [[nodiscard]] const std::vector<int>* near(double x, double y) const;

  const Terrain& terrain_;
  Tube tube_;
  std::vector<Lamp> lamps_;
  bool night_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  int nx_ = 0;
  int ny_ = 0;
  std::vector<std::vector<int>> cells_;  ///< lamps within reach, by place
};

}  // namespace plumb::synth
