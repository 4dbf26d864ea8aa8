/// Turns light into bytes: lens blur, vignetting, exposure, shot and read noise, and quantisation.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/synth/renderer.hpp"

namespace plumb::synth {

struct SensorConfig {
  double blur_px = 0.5;       ///< sigma of the lens' point spread
  double gain = 330.0;        ///< grey levels per unit of radiance
  double gamma = 1.0;         ///< exponent of the tone curve, which keeps 255 at 255
  double read_noise = 0.8;    ///< grey levels
  double shot_noise = 0.008;  ///< variance per grey level
  double vignetting = 0.12;   ///< loss of light in the corners
  double gain_drift =
      0.03;  ///< slow wandering of the exposure, standard deviation of its logarithm
  double step_factor = 1.0;   ///< exposure jumps by this factor ...
  double step_every_s = 0.0;  ///< ... back and forth at this interval; 0 = never
  std::uint64_t seed = 1;
};

class Sensor {
 public:
  explicit Sensor(const SensorConfig& config) : config_(config) {}

  /// The exposure's factor at a time.
  [[nodiscard]] double exposure(double time_s) const;

  /// Develops a frame; `light` scales all of it (a tunnel, a covered lens). The noise depends on
  /// `frame` only.
  void develop(const RenderedFrame& in, double time_s, std::uint64_t frame, double light,
               std::vector<std::uint8_t>& out);

 private:
  void blur(int width, int height);

  SensorConfig config_;
  std::vector<float> image_;
  std::vector<float> scratch_;
};

}  // namespace plumb::synth
