/// Finds the solids that can stand between a point and a light at infinity, by bins across the
/// light's direction.
///
/// Frames:
///   map
/// Memory:
///   build() allocates; queries allocate nothing.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "tools/synth/primitive.hpp"

namespace plumb::synth {

class ShadowGrid {
 public:
  /// @pre to_light is a unit vector; `solids` outlives the grid.
  void build(const std::vector<Primitive>& solids, const Eigen::Vector3d& to_light, double cell_m);

  /// True when a solid hides the light from the point. `softness_rad` closes holes smaller than the
  /// light's blur.
  [[nodiscard]] bool hidden(const Eigen::Vector3d& p_map, double softness_rad,
                            const VolumeNoise& noise) const;

 private:
  const std::vector<Primitive>* solids_ = nullptr;
  Eigen::Vector3d to_light_ = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d axis_u_ = Eigen::Vector3d::UnitX();
  Eigen::Vector3d axis_v_ = Eigen::Vector3d::UnitY();
  double cell_m_ = 1.0;
  int u0_ = 0;
  int v0_ = 0;
  int nu_ = 0;
  int nv_ = 0;
  std::vector<std::int32_t> first_;
  std::vector<std::int32_t> entries_;
};

}  // namespace plumb::synth
