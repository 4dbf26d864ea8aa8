/// The results of a fit as text, JSON and pictures.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "modules/chain/model_file_source.hpp"
#include "tools/learn/train/fit.hpp"

namespace plumb {

struct FitReport {
  TrainedModels models;
  std::vector<HeldOutScore> held_out;
  std::vector<OutputScore> outputs;
  std::vector<CueScore> cues;
  std::vector<ConfidenceFit> paper;
  std::optional<ConfidenceFit> objects;
};

[[nodiscard]] std::string to_text(const std::vector<HeldOutScore>& scores);
[[nodiscard]] std::string to_text(const std::vector<OutputScore>& scores);
[[nodiscard]] std::string to_text(const std::vector<CueScore>& scores);
[[nodiscard]] std::string to_text(const std::vector<ConfidenceFit>& fits);

/// Throws InputError when `path` cannot be written.
void write_json(const FitReport& report, const std::filesystem::path& path);

/// Draws, for each target, the errors over the predicted standard deviations and their root mean
/// square in bins; for each line of the published method, bins and line as in its figures 5 and 6.
/// Returns the files. Throws InputError.
std::vector<std::filesystem::path> draw_fit(const std::vector<DriveSamples>& drives,
                                            const FitReport& report,
                                            const std::filesystem::path& folder,
                                            const std::string& format);

}  // namespace plumb
