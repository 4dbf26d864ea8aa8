/// Reads and writes the reference of the mount as TOML with a schema and a version. Every number
/// must be present and in its range.
#pragma once

#include <string>

#include "modules/mount/mount_check.hpp"

namespace plumb {

/// Throws ConfigError ("FILE:LINE: ...") for a file that cannot be read, has another schema or
/// version, lacks a number or has a number out of range.
[[nodiscard]] MountReference load_mount_reference(const std::string& path);

/// Replaces the file as a whole, so that a power cut leaves the old file. Throws InputError when it
/// cannot be written.
void save_mount_reference(const std::string& path, const MountReference& reference);

}  // namespace plumb
