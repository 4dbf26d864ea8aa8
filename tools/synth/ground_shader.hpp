/// Shades the ground: asphalt with wear, patches, cracks, manholes and markings; kerbs, paving and
/// grass.
#pragma once

#include <utility>
#include <vector>

#include "tools/synth/ground_ray.hpp"
#include "tools/synth/surface.hpp"
#include "tools/synth/terrain.hpp"

namespace plumb::synth {

struct GroundLook {
  double road_contrast = 1.0;  ///< scales the asphalt's texture; 0.2 = almost textureless
  double marking_wear = 0.5;   ///< 0 fresh .. 1 nearly gone
  double wetness = 0.0;        ///< 0 dry .. 1 a mirror of water
  std::uint64_t seed = 1;
};

class GroundShader {
 public:
  GroundShader(const Terrain& terrain, const Textures& textures, const GroundLook& look);

  [[nodiscard]] Reflectance shade(const Patch& patch, const GroundHit& hit) const;

 private:
  struct Here {  ///< one road pixel
    RoadCoordinate road;
    double along_m;   ///< pixel's reach along the road
    double across_m;  ///< and across it
    double edge_m;
  };
  [[nodiscard]] double asphalt(const Patch& patch, const Footprint& f, const Here& here) const;
  [[nodiscard]] double repairs(const Here& here) const;
  [[nodiscard]] double cracks(const Patch& patch, const Here& here) const;
  /// Darkening by the joints of concrete slabs and by tram rails; negative where rails shine.
  [[nodiscard]] double joints_and_rails(const Here& here) const;
  [[nodiscard]] double manholes(const Here& here) const;
  [[nodiscard]] double markings(const Here& here) const;
  [[nodiscard]] float beside(const Patch& patch, const Footprint& f, const Here& here) const;
  [[nodiscard]] Reflectance wet(const Patch& patch, Reflectance dry) const;

  struct Repair {
    double s_m = 0.0;
    double length_m = 0.0;  ///< 0: none here
    double d_m = 0.0;
    double width_m = 0.0;
    double tone = 0.0;
    bool seam = false;
  };
  void plan_details();

  const Terrain& terrain_;
  const Textures& textures_;
  GroundLook look_;
  std::vector<Repair> repairs_;
  std::vector<std::pair<double, double>>
      manholes_;  ///< (s, d) per cell, far away when there is none
  std::vector<bool> dashed_;
};

}  // namespace plumb::synth
