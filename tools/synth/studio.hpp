/// Builds every part of a drive from the configuration, so that it can be rendered.
///
/// Threads:
///   All members are read-only once constructed.
#pragma once

#include "tools/synth/synth_config.hpp"
#include "tools/synth/truth.hpp"

namespace plumb::synth {

class Studio {
 public:
  explicit Studio(const SynthConfig& config);

  [[nodiscard]] double time_s(int frame) const { return frame / config_.rate_hz + 0.1; }
  [[nodiscard]] World world() const {
    return {terrain_, drive_, scene_, textures_, lighting_, ground_, still_shadows_, lamps_};
  }
  [[nodiscard]] const SynthConfig& config() const { return config_; }
  [[nodiscard]] const Drive& drive() const { return drive_; }
  [[nodiscard]] const Terrain& terrain() const { return terrain_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const Attached& attached() const { return attached_; }
  /// By how much the camera opens up at a time, because it is in the tube.
  [[nodiscard]] double tube_exposure(double since_start_s) const {
    return tube_exposure_.factor(since_start_s);
  }
  /// Frames that the route lasts, at most the configured number.
  [[nodiscard]] int num_frames() const;

 private:
  SynthConfig config_;
  Route route_;
  Terrain terrain_;
  Drive drive_;
  Scene scene_;
  Textures textures_;
  Lighting lighting_;
  GroundShader ground_;
  ShadowGrid still_shadows_;
  Lamps lamps_;
  DarkSpan tube_exposure_;
  Attached attached_;
};

}  // namespace plumb::synth
