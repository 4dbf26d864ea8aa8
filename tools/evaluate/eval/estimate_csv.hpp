/// Reads the ground planes that plumb-replay wrote with --csv.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

/// One row. Empty cells are absent; the status says why.
struct EstimatedPlane {
  std::int64_t seq = 0;
  std::string status;  ///< "ok", "held", "initializing", "invalid"
  std::optional<double> height_m;
  std::optional<double> pitch_rad;
  std::optional<double> roll_rad;
  std::optional<double> height_std_m;
  std::optional<double> pitch_std_rad;
  std::optional<double> roll_std_rad;
};

/// Columns are found by the names in the first line: seq, height_m, pitch_rad and roll_rad must be
/// present; plane_status and the standard deviations are optional. Throws InputError with file,
/// line and column.
[[nodiscard]] std::vector<EstimatedPlane> read_estimate_csv(const std::filesystem::path& path);

}  // namespace plumb
