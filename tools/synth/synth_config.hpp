/// The configuration of a rendered drive.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "tools/synth/attached.hpp"
#include "tools/synth/drive.hpp"
#include "tools/synth/ground_shader.hpp"
#include "tools/synth/lighting.hpp"
#include "tools/synth/renderer.hpp"
#include "tools/synth/scene.hpp"
#include "tools/synth/sensor.hpp"

namespace plumb::synth {

/// Says in one sentence which options contradict each other or cannot be met.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A stretch of time in which less light comes in: a tunnel, a covered lens.
struct DarkSpan {
  double from_s = 0.0;
  double to_s = 0.0;   ///< empty when not after from_s
  double light = 0.0;  ///< share of the light that is left
  double fade_s = 0.0;

  [[nodiscard]] double factor(double time_s) const;
};

struct SynthConfig {
  std::filesystem::path out;
  std::string route = "city";
  std::filesystem::path poses;
  int first_row = 0;
  int last_row = -1;
  double source_rate_hz = 9.65;
  int frames = 200;
  std::uint64_t seed = 1;
  double rate_hz = 10.0;
  double stated_height_m = 0.0;  ///< camera height that calib.txt claims; 0 = the true one
  bool flat = false;
  int bumps = 0;
  DriveConfig drive;
  SceneConfig scene;
  RenderConfig render;
  GroundLook ground;
  LightConfig light;
  SensorConfig sensor;
  AttachedConfig attached;
  double compression = 0.0;  ///< step of the codec's quantiser, grey levels; 0 = none
  bool stamp = false;        ///< a printed time stamp
  DarkSpan tunnel;
  DarkSpan covered;
};

}  // namespace plumb::synth
