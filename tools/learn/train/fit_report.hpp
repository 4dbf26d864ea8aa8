/// What a fit has found, as text, JSON and pictures.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/learn/train/fit.hpp"

namespace plumb {

struct FitReport {
  GroundModel model;
  std::vector<HeldOutScore> held_out;
  std::vector<OutputScore> outputs;
  std::vector<BeliefFit> paper;
  std::optional<BeliefFit> objects;
};

[[nodiscard]] std::string to_text(const std::vector<HeldOutScore>& scores);
[[nodiscard]] std::string to_text(const std::vector<OutputScore>& scores);
[[nodiscard]] std::string to_text(const std::vector<BeliefFit>& fits);

/// Throws InputError when `path` cannot be written.
void write_json(const FitReport& report, const std::filesystem::path& path);

/// Per target: errors over the deviations that the model foretells, and their root mean square in bins; per line of the
/// published method: bins and line, as its figures 5 and 6. Returns the files. Throws InputError.
std::vector<std::filesystem::path> draw_fit(const std::vector<DriveSamples>& drives,
                                            const FitReport& report,
                                            const std::filesystem::path& folder,
                                            const std::string& format);

}  // namespace plumb
