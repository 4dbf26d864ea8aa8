/// Reads a whole file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace plumb {

/// Reads every byte of `path`. Throws InputError when it cannot be read.
[[nodiscard]] std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path);

}  // namespace plumb
