/// Ground plane, scale and metric ego-motion from VO's motion, its road points and the images.
///
/// Pure algorithm: no clock, no I/O, no heap after construction.
///
/// Frames:
///   cam: x right, y down, z forward.
///   world: cam of the first image.
///   ground: x forward, y left, z up, on the road under the camera.
///   T_a_b maps b to a.
///   The plane is normal_cam . X = height; the normal points DOWN.
/// Units:
///   [vo] is VO's own unit of length; names that end in _m are metric.
/// Memory:
///   A ring of image pyramids, sized at construction; nothing grows.
#pragma once

#include <memory>

#include "core/stage_probe.hpp"
#include "modules/ground/covariance/ground_model.hpp"
#include "modules/ground/cues/cue_diagnostics.hpp"
#include "modules/ground/types/ground_types.hpp"

namespace plumb {

/// What GroundNode runs. One `update` per VO result, in order; deterministic in configuration,
/// camera and inputs.
class GroundAlgorithm {
 public:
  virtual ~GroundAlgorithm() = default;
  GroundAlgorithm() = default;
  GroundAlgorithm(const GroundAlgorithm&) = delete;
  GroundAlgorithm& operator=(const GroundAlgorithm&) = delete;

  /// Takes one VO result and its image. The result stays valid until the next call.
  virtual const GroundOutput& update(const GroundInput& input, StageProbe& probe) = 0;
  /// What went into the last update; null when the algorithm does not tell.
  [[nodiscard]] virtual const CueDiagnostics* diagnostics() const { return nullptr; }
};

/// The default algorithm: an extended Kalman filter of the road plane (plane_filter.hpp), fed by
/// the cues of kCueTable.
class GroundEstimator final : public GroundAlgorithm {
 public:
  /// @pre config inside the ranges of its visit(); camera.width_px, height_px >= 64
  GroundEstimator(const GroundConfig& config, const CameraModel& camera,
                  const GroundModel& model = built_in_ground_model());
  ~GroundEstimator() override;

  const GroundOutput& update(const GroundInput& input, StageProbe& probe) override;
  [[nodiscard]] const CueDiagnostics* diagnostics() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
