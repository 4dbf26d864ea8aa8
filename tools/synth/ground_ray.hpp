/// Intersects rays from one place with the terrain, crests included.
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
#include "tools/synth/terrain.hpp"

namespace plumb::synth {

enum class GroundPart : std::uint8_t { kRoad, kKerbFace, kBeside };

struct GroundHit {
  double t = 1e30;
  GroundPart part = GroundPart::kRoad;
  double edge_m = 0.0;  ///< signed distance to the road edge
};

class GroundRays {
 public:
  /// Looks from `origin` over headings within `half_view_rad` of `yaw_rad`.
  void build(const Terrain& terrain, const Eigen::Vector3d& origin, double yaw_rad,
             double half_view_rad);

  /// Finds the first ground along a ray that starts near the origin. Returns false for the sky.
  bool intersect(const Ray& ray, GroundHit& hit) const;

 private:
  bool resolve_kerb(const Ray& ray, double closing, GroundHit& hit) const;

  const Terrain* terrain_ = nullptr;
  double c_ = 1.0;
  double s_ = 0.0;
  double half_width_ = 1.0;  ///< tangent of the widest angle
  int num_columns_ = 0;
  std::vector<double> ranges_m_;
  std::vector<float>
      steepest_;  ///< running maximum of (height - eye) / range, per azimuth and range
};

}  // namespace plumb::synth
