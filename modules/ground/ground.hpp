/// Ground plane, scale and metric ego-motion from VO motion, road points and the images themselves.
///
/// Pure algorithm: no clock, no I/O, no heap after construction. `main.cpp` is the process around
/// it.
///
/// Frames   cam: x right, y down, z forward.  ground: x forward, y left, z up, on the road under
/// the camera.
///          world: cam of the first image.  T_a_b maps b to a.  Plane: normal_cam . X = height, n
///          points DOWN.
/// Units    [vo] is VO's own unit; names that end in _m are metric.
/// Memory   a ring of image pyramids, sized at construction; nothing grows.
#pragma once

#include <memory>

#include "core/stage_probe.hpp"
#include "modules/ground/covariance/ground_model.hpp"
#include "modules/ground/types/ground_types.hpp"

namespace plumb {

struct GroundSight;

/// One `update` per VO result, in order. Deterministic in config, camera and the inputs.
class GroundAlgorithm {
 public:
  virtual ~GroundAlgorithm() = default;
  GroundAlgorithm() = default;
  GroundAlgorithm(const GroundAlgorithm&) = delete;
  GroundAlgorithm& operator=(const GroundAlgorithm&) = delete;

  /// Takes one VO result and its image. The result stays valid until the next call.
  virtual const GroundOutput& update(const GroundInput& input, StageProbe& probe) = 0;
  /// What the last update's cues saw (ground_sight.hpp); null when the algorithm does not tell.
  [[nodiscard]] virtual const GroundSight* sight() const { return nullptr; }
};

/// The default algorithm. (`paper/` has the published one; `make_ground_algorithm` chooses.)
class GroundEstimator final : public GroundAlgorithm {
 public:
  /// @pre config inside the ranges of its visit(); camera.width_px, height_px >= 64
  GroundEstimator(const GroundConfig& config, const CameraModel& camera,
                  const GroundModel& model = built_in_ground_model());
  ~GroundEstimator() override;

  const GroundOutput& update(const GroundInput& input, StageProbe& probe) override;
  [[nodiscard]] const GroundSight* sight() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The default algorithm, as a factory for GroundNode.
[[nodiscard]] std::unique_ptr<GroundAlgorithm> make_ground_estimator(const GroundConfig& config,
                                                                     const CameraModel& camera,
                                                                     const GroundModel& model);

}  // namespace plumb
