#include "modules/chain/ground_algorithm.hpp"

#include "modules/ground_paper/paper_ground.hpp"

namespace plumb {

std::unique_ptr<GroundAlgorithm> make_ground_algorithm(const GroundConfig& config,
                                                       const CameraModel& camera,
                                                       const GroundModel& model) {
  if (config.mode == "paper") return std::make_unique<PaperGround>(config, camera, model.paper);
  return std::make_unique<GroundEstimator>(config, camera, model);
}

}  // namespace plumb
