/// The ground algorithm that the configuration names.
#pragma once

#include <memory>

#include "modules/ground/ground.hpp"

namespace plumb {

/// @pre config inside the ranges of its visit(); camera.width_px, height_px >= 64
[[nodiscard]] std::unique_ptr<GroundAlgorithm> make_ground_algorithm(
    const GroundConfig& config, const CameraModel& camera,
    const GroundModel& model = built_in_ground_model());

}  // namespace plumb
