/// Ground plane, scale and metric motion by Song and Chandraker, "Robust Scale Estimation in
/// Real-Time Monocular SFM for Autonomous Driving", CVPR 2014.
///
/// Cues, covariances, fusion (5) and filter (3)-(4) are the paper's; motion and pose come out of
/// the same EgoMotion as the default's. README.md beside this file lists what the paper leaves
/// open and what differs.
///
/// Scale   lengths of VO are taken times metres_per_vo, which is corrected by s = h / h* after
///         every frame that saw a height; so h stays near the camera's true height h*.
/// Memory  twelve images and the road region, at construction. SIFT uses the heap in every frame:
///         this mode is exempt from the rule that the default keeps, and made for comparison.
#pragma once

#include <memory>

#include "modules/ground/covariance/paper_model.hpp"
#include "modules/ground/ground.hpp"

namespace plumb {

class PaperGround final : public GroundAlgorithm {
 public:
  /// @pre config inside the ranges of its visit(); camera.width_px, height_px >= 64
  PaperGround(const GroundConfig& config, const CameraModel& camera,
              const PaperModel& model = built_in_ground_model().paper);
  ~PaperGround() override;

  const GroundOutput& update(const GroundInput& input, StageProbe& probe) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
