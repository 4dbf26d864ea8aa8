/// Files of trained models: TOML, one schema and version, every number there and in its range.
#pragma once

#include <string>

#include "modules/ground/covariance/ground_model.hpp"

namespace plumb {

/// Throws ConfigError ("FILE:LINE: ...") for a file that cannot be read, is of another schema or version, lacks a
/// number, has one that is unknown or out of range, or bounds that contradict each other.
/// An empty path gives the built-in model.
[[nodiscard]] GroundModel load_ground_model(const std::string& path);

/// The text of a model file that load_ground_model() reads; numbers rounded to `kModelDigits`.
[[nodiscard]] std::string ground_model_text(const GroundModel& model);

inline constexpr int kModelDigits = 4;

}  // namespace plumb
