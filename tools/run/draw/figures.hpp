/// Reads plumb-replay's tables as figures to draw onto frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "tools/run/draw/overlay.hpp"

namespace plumb {

/// Figures per sequence number. Throws InputError with file, line and column.
[[nodiscard]] std::map<std::int64_t, FrameFigures> read_figures(const std::filesystem::path& csv);

/// Adds the objects of plumb-replay --objects to the frames they were seen in. Throws InputError as
/// above.
void read_objects(const std::filesystem::path& csv, std::map<std::int64_t, FrameFigures>* figures);

}  // namespace plumb
