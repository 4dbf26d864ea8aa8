/// The mount's reference in a file: TOML, one schema and version, every number there and in its range.
#pragma once

#include <string>

#include "modules/mount/mount_check.hpp"

namespace plumb {

/// Throws ConfigError ("FILE:LINE: ...") for a file that cannot be read, is of another schema or
/// version, lacks a number or has one out of range.
[[nodiscard]] MountReference load_mount_reference(const std::string& path);

/// Whole or not at all: a power cut leaves the old file. Throws InputError when it cannot be written.
void save_mount_reference(const std::string& path, const MountReference& reference);

}  // namespace plumb
