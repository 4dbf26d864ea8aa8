/// Files of trained models: TOML with one schema and version, every number present and in its
/// range.
#pragma once

#include <string>

#include "modules/ground/covariance/ground_model.hpp"
#include "modules/ground_paper/paper_model.hpp"

namespace plumb {

/// Everything that one model file holds, for both algorithms.
struct TrainedModels {
  GroundModel ground = built_in_ground_model();
  PaperModel paper = built_in_paper_model();
};

/// An empty path gives the built-in models. Throws ConfigError ("FILE:LINE: ...") for a file that
/// cannot be read, has another schema or version, lacks a number, has one that is unknown or out of
/// range, or whose bounds contradict each other.
[[nodiscard]] TrainedModels load_models(const std::string& path);

/// The text of a model file that load_models() reads; numbers are rounded to `kModelDigits`.
[[nodiscard]] std::string models_text(const TrainedModels& models);

inline constexpr int kModelDigits = 4;

}  // namespace plumb
