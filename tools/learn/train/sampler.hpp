/// Turns what the chain said about each frame of a log into a sample: what the cues measured, and
/// their errors against the truth.
#pragma once

#include <cstdint>
#include <vector>

#include "modules/ground/cues/cue_diagnostics.hpp"
#include "modules/vo/vo.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "tools/learn/train/sample.hpp"
#include "tools/learn/train/truth_track.hpp"

namespace plumb {

/// What the chain said about one image.
struct SampledFrame {
  const VoOutput* vo = nullptr;
  const CueDiagnostics* diagnostics = nullptr;  ///< null in paper mode
  const GroundOutput* output = nullptr;
  const ground_plane_t* plane = nullptr;
  const ego_motion_t* ego = nullptr;
};

class Sampler {
 public:
  /// `nominal_height_m` replaces the height where there is no true plane.
  Sampler(const TruthTrack* truth, double nominal_height_m);

  /// Takes one frame. Frames without truth, or before the scale is known, give no sample.
  void add(const SampledFrame& frame);

  /// Returns all samples, with every truth_ln_std filled in. Call once, at the end.
  [[nodiscard]] std::vector<Sample> take();

 private:
  struct Reference;
  [[nodiscard]] bool take_truth(const VoOutput& vo, Sample* sample, Reference* reference);
  void add_cues(const CueDiagnostics& diagnostics, double ln_scale, const TruePlane* plane,
                Sample* sample) const;

  const TruthTrack* truth_;
  double nominal_height_m_;
  std::vector<Sample> samples_;
  std::vector<double> step_misfits_m_;  ///< true step minus VO's at the chord's scale
};

}  // namespace plumb
