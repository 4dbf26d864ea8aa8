#include "modules/chain/ground_algorithm.hpp"

#include "modules/ground_paper/paper_ground.hpp"

namespace plumb {

GroundNode::Factory ground_factory(const PlumbConfig& config, const TrainedModels& models) {
  const GroundConfig& ground = config.ground;
  if (config.ground_mode == "paper") {
    return [ground, paper = config.ground_paper, detections = config.detections,
            models](const CameraModel& camera) {
      return std::make_unique<PaperGround>(ground, paper, detections, camera, models.paper);
    };
  }
  return [ground, models](const CameraModel& camera) {
    return std::make_unique<GroundEstimator>(ground, camera, models.ground);
  };
}

}  // namespace plumb
