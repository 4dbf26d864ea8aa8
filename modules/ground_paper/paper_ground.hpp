/// Ground plane, scale and metric motion by Song and Chandraker, "Robust Scale Estimation in
/// Real-Time Monocular SFM for Autonomous Driving", CVPR 2014.
///
/// Cues, covariances, fusion (5) and filter (3)-(4) are the paper's. Motion and pose come from the
/// same EgoMotion as the default's. README.md beside this file lists what the paper leaves open and
/// what differs.
///
/// Scale:
///   VO's lengths are multiplied by metres_per_vo, which is corrected by s = h / h* after every
///   frame that measured a height, so that h stays near the camera's true height h*.
/// Frames:
///   As in ground.hpp.
/// Memory:
///   Twelve images and the road region, at construction. SIFT uses the heap in every frame. This
///   mode is made for comparison, and is exempt from the rule that the default keeps.
#pragma once

#include <memory>

#include "modules/detections/detections_config.hpp"
#include "modules/ground/ground.hpp"
#include "modules/ground_paper/paper_config.hpp"
#include "modules/ground_paper/paper_model.hpp"

namespace plumb {

class PaperGround final : public GroundAlgorithm {
 public:
  /// @pre configs inside the ranges of their visit(); camera.width_px, height_px >= 64
  PaperGround(const GroundConfig& config, const PaperConfig& paper,
              const DetectionsConfig& detections, const CameraModel& camera,
              const PaperModel& model = built_in_paper_model());
  ~PaperGround() override;

  const GroundOutput& update(const GroundInput& input, StageProbe& probe) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
