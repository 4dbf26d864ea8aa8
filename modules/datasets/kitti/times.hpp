/// Reads the capture times of KITTI frames.
///
/// Errors:
///   Functions throw InputError.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace plumb {

/// Reads times.txt of an odometry sequence: one row per frame, in seconds since its start.
[[nodiscard]] std::vector<std::int64_t> read_odometry_times_us(const std::filesystem::path& path);

/// Reads timestamps.txt of a raw drive: rows like "2011-09-26 13:02:25.964389445", taken as UTC.
[[nodiscard]] std::vector<std::int64_t> read_raw_times_us(const std::filesystem::path& path);

}  // namespace plumb
