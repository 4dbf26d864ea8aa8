/// Replaces a file as a whole, so that a power cut leaves the old text or the new one.
///
/// Memory:
///   It allocates nothing.
#pragma once

#include <string>
#include <string_view>

namespace plumb {

/// Writes the text to "PATH.part", brings it to the disk, renames it to `path` and brings the
/// folder's entry to the disk, too. Returns false, with errno, when the system refuses one of
/// these; the old file is then still there.
[[nodiscard]] bool replace_file(const std::string& path, std::string_view text);

}  // namespace plumb
