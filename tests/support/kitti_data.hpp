/// Where the real KITTI drives are, if this machine has them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "plumb_paths.hpp"

namespace plumb::test {

/// Folder of one real sequence ("odometry/sequences/04_000-050", "raw/drive0039_024-400"), empty when not here.
/// Looks in $PLUMBLINE_DATA, else in ../shared/data beside the checkout.
inline std::filesystem::path kitti_sequence(const std::string& name) {
  const char* root = std::getenv("PLUMBLINE_DATA");
  const std::filesystem::path base =
      root != nullptr ? std::filesystem::path(root)
                      : std::filesystem::path(PLUMB_SOURCE_DIR) / ".." / "shared" / "data";
  const std::filesystem::path folder = base / "kitti" / name;
  std::error_code ignored;
  return std::filesystem::is_directory(folder, ignored) ? folder : std::filesystem::path();
}

/// What a test prints when it skips for want of data.
inline constexpr const char* kNoKitti =
    "real KITTI frames are not here: set PLUMBLINE_DATA to run this test";

}  // namespace plumb::test
