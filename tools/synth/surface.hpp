/// What a pixel sees of a surface, and how that surface reflects light.
///
/// Frames:
///   map
/// Units:
///   Reflectance and radiance are relative; 1 is a white sheet that faces a light of strength 1.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tools/synth/noise_texture.hpp"

namespace plumb::synth {

struct Patch {
  Eigen::Vector3d p_map;
  Eigen::Vector3d n_map;  ///< unit, towards the viewer's side
  Eigen::Vector3d view;   ///< unit, from the eye to the point
  double width_m = 0.01;  ///< one pixel across the view
  Eigen::Vector3d smear =
      Eigen::Vector3d::Zero();  ///< [m] motion of the surface past the eye during the exposure
};

struct Reflectance {
  float albedo = 0.2F;
  float gloss = 0.0F;         ///< share of mirror reflection at normal incidence scale
  float glow = 0.0F;          ///< radiance of its own at night
  bool always_glows = false;  ///< by day as well
  float openness = 1.0F;      ///< share of the sky that is not blocked close by
  Eigen::Vector3d n_map = Eigen::Vector3d::UnitZ();
};

/// The textures everything is made from; built once, read by all threads.
struct Textures {
  NoiseTexture grain;   ///< centimetres: stones, plaster
  NoiseTexture stains;  ///< decimetres to metres
  VolumeNoise volume;

  explicit Textures(std::uint64_t seed)
      : grain(10, 0.005, {0.5, 1.0, 0.6, 0.3}, seed + 11U),
        stains(9, 0.06, {0.35, 0.5, 0.6, 0.8, 1.0, 1.0, 0.8}, seed + 12U),
        volume(seed + 13U) {}
};

/// The pixel's footprint in a texture whose axes are the unit vectors ex and ey of the surface.
[[nodiscard]] inline Footprint footprint(const Patch& patch, const Eigen::Vector3d& ex,
                                         const Eigen::Vector3d& ey) {
  const double facing = patch.view.dot(patch.n_map);
  const double length = patch.width_m / std::max(std::abs(facing), 0.02);
  const Eigen::Vector3d along = patch.view - facing * patch.n_map;
  const double norm = along.norm();
  const double scale = norm > 1e-9 ? length / norm : 0.0;
  const double sense =
      along.dot(patch.smear) < 0.0 ? -1.0 : 1.0;  // lengths add, whichever way we move
  return {scale * along.dot(ex) + sense * patch.smear.dot(ex),
          scale * along.dot(ey) + sense * patch.smear.dot(ey), patch.width_m};
}

/// Share of [x - width/2, x + width/2] that lies in [low, high].
[[nodiscard]] inline double coverage(double x, double low, double high, double width) {
  const double half = 0.5 * std::max(width, 1e-6);
  return std::clamp((std::min(x + half, high) - std::max(x - half, low)) / (2.0 * half), 0.0, 1.0);
}

/// Share of the pixel in a stripe [low, high] of a pattern repeating every `period`.
[[nodiscard]] inline double stripe(double x, double period, double low, double high, double width) {
  if (width > 0.8 * period) return (high - low) / period;
  const double phase = x - period * std::floor(x / period);
  return coverage(phase, low, high, width) + coverage(phase - period, low, high, width) +
         coverage(phase + period, low, high, width);
}

/// How far the pixel reaches along each texture axis.
[[nodiscard]] inline double reach_x(const Footprint& f) { return std::abs(f.axis_x_m) + f.minor_m; }
[[nodiscard]] inline double reach_y(const Footprint& f) { return std::abs(f.axis_y_m) + f.minor_m; }

}  // namespace plumb::synth
