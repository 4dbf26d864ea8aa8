/// Finds the real KITTI drives, if this machine has them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "plumb_paths.hpp"

namespace plumb::test {

/// Folder of one real sequence ("odometry/sequences/04_000-050", "raw/drive0039_024-400"), or an
/// empty path when it does not exist. Looks in $PLUMBLINE_DATA or, when that is not set, in
/// ../shared/data beside the checkout.
inline std::filesystem::path kitti_sequence(const std::string& name) {
  const char* root = std::getenv("PLUMBLINE_DATA");
  const std::filesystem::path base =
      root != nullptr ? std::filesystem::path(root)
                      : std::filesystem::path(PLUMB_SOURCE_DIR) / ".." / "shared" / "data";
  const std::filesystem::path folder = base / "kitti" / name;
  std::error_code ignored;
  return std::filesystem::is_directory(folder, ignored) ? folder : std::filesystem::path();
}

/// The message of a test that is skipped because the data is missing.
inline constexpr const char* kNoKitti =
    "real KITTI frames are not here: set PLUMBLINE_DATA to run this test";

}  // namespace plumb::test
