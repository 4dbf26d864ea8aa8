#include "tools/synth/lighting.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::synth {

Lighting::Lighting(const LightConfig& config, const Textures& textures)
    : config_(config),
      textures_(textures),
      to_sun_(std::cos(config.sun_elevation_rad) * std::cos(config.sun_azimuth_rad),
              std::cos(config.sun_elevation_rad) * std::sin(config.sun_azimuth_rad),
              std::sin(config.sun_elevation_rad)) {}

float Lighting::sky(const Eigen::Vector3d& direction, double pixel_rad) const {
  const double up = direction.z() / std::max(1e-6, std::hypot(direction.x(), direction.y()));
  const double azimuth = std::atan2(direction.y(), direction.x());
  // Woods and hills on the horizon.
  const double ridge =
      0.016 + 0.028 * static_cast<double>(textures_.volume.sample(azimuth * 9.0 + 70.0, 0.5, 0.5)) +
      0.006 * static_cast<double>(textures_.volume.sample(azimuth * 90.0 + 700.0, 3.5, 0.5));
  const double woods = std::clamp((ridge - up) / pixel_rad + 0.5, 0.0, 1.0);
  const double bark =
      static_cast<double>(textures_.volume.sample(azimuth * 160.0 + 900.0, up * 260.0 + 50.0, 2.5));
  const double wood_tone = 0.10 + 0.10 * bark;

  const double clear = config_.sky_tone * (0.8 + 0.4 * std::exp(-6.0 * std::max(0.0, up)));
  double tone = clear;
  if (config_.clouds > 0.0) {
    const double height = 1.0 / std::max(0.06, up + 0.05);
    const double x = height * std::cos(azimuth);
    const double y = height * std::sin(azimuth);
    const auto noise = [&](double f) {
      return static_cast<double>(textures_.volume.sample(f * x + 31.0, f * y + 31.0, 9.5));
    };
    const double cover = 0.6 * noise(0.7) + 0.3 * noise(1.7) + 0.1 * noise(4.3);
    const double cloud = std::clamp((cover - 0.75 + 0.5 * config_.clouds) * 3.5, 0.0, 1.0);
    tone += cloud * (1.0 + 0.3 * cover - tone);
  }
  const double glare = direction.dot(to_sun_);
  if (config_.sun > 0.0 && glare > 0.7)
    tone += 0.5 * std::pow(glare, 12.0) + (glare > 0.99 ? 60.0 * std::pow(glare, 4000.0) : 0.0);
  const double lit = std::max(config_.night ? 0.0 : 0.15, config_.sky / 0.55);
  return static_cast<float>(lit * (tone + woods * (wood_tone - tone)));
}

float Lighting::answer(const Reflectance& surface, const Eigen::Vector3d& view,
                       float sunlit) const {
  const double facing = std::max(0.0, surface.n_map.dot(to_sun_));
  const double dome = 0.5 + 0.5 * surface.n_map.z();
  const double bounce = 0.12 * (1.0 - dome) * (config_.sun * to_sun_.z() + config_.sky);
  double radiance = static_cast<double>(surface.albedo) *
                    (config_.sun * facing * static_cast<double>(sunlit) +
                     static_cast<double>(surface.openness) * (config_.sky * dome + bounce));
  if (surface.gloss > 0.0F) {
    const double against = -view.dot(surface.n_map);
    const Eigen::Vector3d mirrored = view + 2.0 * against * surface.n_map;
    const double grazing = 1.0 - std::clamp(against, 0.0, 1.0);
    const double fresnel = 0.04 + 0.96 * grazing * grazing * grazing * grazing * grazing;
    // A smooth pattern stands in for the surroundings: bright sky above, houses near the horizon,
    // and dark road below.
    const double up = mirrored.z();
    const double seen = up > 0.12 ? 0.75 + 0.4 * (1.0 - up) : up > 0.0 ? 0.3 + 3.7 * up : 0.15;
    const double spark =
        sunlit > 0.5F ? config_.sun * 25.0 * std::pow(std::max(0.0, mirrored.dot(to_sun_)), 350.0)
                      : 0.0;
    radiance += static_cast<double>(surface.gloss) * fresnel * (seen * config_.sky / 0.55 + spark);
  }
  return static_cast<float>(radiance);
}

float Lighting::through_air(float radiance, double distance_m) const {
  const auto clear = static_cast<float>(std::exp(-distance_m / config_.haze_m));
  return radiance * clear +
         (1.0F - clear) *
             static_cast<float>(0.75 * std::max(config_.night ? 0.0 : 0.2, config_.sky / 0.55));
}

}  // namespace plumb::synth
