/// Capture times of KITTI frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace plumb {

/// times.txt of the odometry sequences: seconds from the sequence's start, one per row. Throws
/// InputError.
[[nodiscard]] std::vector<std::int64_t> read_odometry_times_us(const std::filesystem::path& path);

/// timestamps.txt of raw drives: "2011-09-26 13:02:25.964389445" per row, taken as UTC. Throws
/// InputError.
[[nodiscard]] std::vector<std::int64_t> read_raw_times_us(const std::filesystem::path& path);

}  // namespace plumb
