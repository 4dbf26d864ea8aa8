/// The one place that knows all ground algorithms and makes the configured one.
#pragma once

#include "modules/chain/model_file_source.hpp"
#include "modules/chain/plumb_config.hpp"
#include "modules/ground/ground_node.hpp"

namespace plumb {

/// A factory for GroundNode that makes what `ground.mode` names.
/// @pre config inside the ranges of its visit()
[[nodiscard]] GroundNode::Factory ground_factory(const PlumbConfig& config,
                                                 const TrainedModels& models);

}  // namespace plumb
