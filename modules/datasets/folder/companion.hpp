/// Finds the files that lie beside a recording and describe it, such as times.txt and calib.txt.
#pragma once

#include <filesystem>
#include <initializer_list>

namespace plumb {

/// The first file of `names` in a folder of images or beside a file, else in the folder above.
/// Empty when there is none.
[[nodiscard]] std::filesystem::path find_companion(const std::filesystem::path& recording,
                                                   std::initializer_list<const char*> names);

}  // namespace plumb
