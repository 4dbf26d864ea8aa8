/// Sun, sky and haze: the light on a surface and the radiance of the sky.
///
/// Frames:
///   map
/// Units:
///   Radiance is relative (surface.hpp).
#pragma once

#include <Eigen/Core>

#include "tools/synth/surface.hpp"

namespace plumb::synth {

struct LightConfig {
  double sun_azimuth_rad = 0.7;  ///< in map, from where the light comes
  double sun_elevation_rad = 0.65;
  double sun = 2.1;       ///< strength of direct light; 0 = overcast
  double sky = 0.55;      ///< strength of the sky's light
  double sky_tone = 0.8;  ///< brightness of what is seen of the sky
  double clouds = 0.4;    ///< 0 clear .. 1 covered
  bool night = false;     ///< the sky has no light but `sky`
  double haze_m = 900.0;  ///< distance over which contrast falls to 1/e
};

class Lighting {
 public:
  Lighting(const LightConfig& config, const Textures& textures);

  [[nodiscard]] const Eigen::Vector3d& to_sun() const { return to_sun_; }
  [[nodiscard]] bool has_sun() const { return config_.sun > 0.0; }

  /// Radiance of a ray that meets no surface. `pixel_rad` is the angle of a pixel.
  [[nodiscard]] float sky(const Eigen::Vector3d& direction, double pixel_rad) const;

  /// Light that a surface sends towards the viewer. `sunlit` is 0 in shadow.
  [[nodiscard]] float answer(const Reflectance& surface, const Eigen::Vector3d& view,
                             float sunlit) const;

  /// Adds the haze between the eye and a point to the point's radiance.
  [[nodiscard]] float through_air(float radiance, double distance_m) const;

 private:
  LightConfig config_;
  const Textures& textures_;
  Eigen::Vector3d to_sun_;
};

}  // namespace plumb::synth
