/// Tileable noise with mip levels that are averaged over areas, so that a texture has the variance
/// that a real pixel would see.
///
/// Units:
///   metres on the surface; values have mean 0 and standard deviation 1 at level 0.
/// Memory:
///   4/3 * 2 bytes per texel, allocated once.
#pragma once

#include <cstdint>
#include <vector>

namespace plumb::synth {

/// The footprint of a pixel on a surface in texture axes: a parallelogram of length |axis| and
/// width `minor_m`.
struct Footprint {
  double axis_x_m = 0.0;
  double axis_y_m = 0.0;
  double minor_m = 0.0;
};

class NoiseTexture {
 public:
  /// Sum of octaves; weights[o] belongs to wavelength 2^o texels. The tile has 2^log2_size texels.
  NoiseTexture(int log2_size, double texel_m, const std::vector<double>& weights,
               std::uint64_t seed);

  /// Average over the footprint (taps along the long axis, two mip levels across).
  [[nodiscard]] float sample(double x_m, double y_m, const Footprint& pixel) const;

  /// Average over a square of side `width_m`.
  [[nodiscard]] float sample(double x_m, double y_m, double width_m) const;

  [[nodiscard]] double texel_m() const { return texel_m_; }

 private:
  struct Level {
    std::vector<std::int16_t> texels;
    int log2_size = 0;
  };
  [[nodiscard]] float bilinear(const Level& level, double x_texel, double y_texel) const;

  double texel_m_;
  std::vector<Level> levels_;
};

/// Smooth tileable noise in three dimensions, values in [0, 1], mean 0.5; period 64 lattice cells.
class VolumeNoise {
 public:
  explicit VolumeNoise(std::uint64_t seed);
  /// Coordinates in lattice cells.
  [[nodiscard]] float sample(double x, double y, double z) const;

 private:
  std::vector<std::uint8_t> lattice_;
};

}  // namespace plumb::synth
