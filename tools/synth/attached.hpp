/// What is fixed to the camera: dashboard, bonnet and reflections in the windscreen.
///
/// Reflections and dashboard move with nothing; their brightness follows the light outside. The
/// bonnet mirrors the scene above it.
/// Units:
///   Radiance as in surface.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/synth/renderer.hpp"

namespace plumb::synth {

struct AttachedConfig {
  double dashboard = 0.0;    ///< share of the picture's height that it hides at the bottom
  double bonnet = 0.0;       ///< the same of the bonnet, above the dashboard
  double reflections = 0.0;  ///< of the dashboard in the windscreen; 1 = as bright as a dark road
  std::uint64_t seed = 1;
};

class Attached {
 public:
  Attached(const AttachedConfig& config, const Textures& textures, int width_px, int height_px);

  /// Lays it over a rendered frame. Hidden pixels belong to no object and have no distance.
  void lay_over(RenderedFrame& frame) const;

 private:
  struct Shares {
    float dashboard = 0.0F;  ///< 0 outside .. 1 hidden by it
    float bonnet = 0.0F;
  };
  void draw_edges(const AttachedConfig& config);
  void draw_dashboard(const AttachedConfig& config, const Textures& textures);
  void draw_reflections(const AttachedConfig& config, const Textures& textures);
  [[nodiscard]] float mirrored(const RenderedFrame& frame, int u, int v) const;

  int width_px_;
  int height_px_;
  std::vector<double> dashboard_top_;  ///< [column] row at which it begins
  std::vector<double> bonnet_top_;
  std::vector<Shares> shares_;  ///< per pixel; empty when nothing is attached
  std::vector<float> tone_;     ///< of the dashboard in units of the light outside
  std::vector<float> veil_;     ///< of the reflections, in the same units
};

}  // namespace plumb::synth
