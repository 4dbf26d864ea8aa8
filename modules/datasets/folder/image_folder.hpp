/// Lists the images of a folder in order of time, whatever they are called.
///
/// Order:
///   By the text before the last number of the name, then by that number, then by the name.
/// Time:
///   1. A file with one time per image [s], when there is one.
///   2. The names, when all of them are times: nanoseconds (19 digits), microseconds (16),
///      milliseconds (13), or seconds with a decimal point, since 1970.
///   3. A stated rate. Numbers in the names count frames, so that missing ones leave their gap;
///      numbers that all differ by a multiple of n count every n-th frame.
/// Errors:
///   Functions throw InputError.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

struct FolderImage {
  std::filesystem::path path;
  std::int64_t seq = 0;         ///< increases; by more than one where images are missing
  std::int64_t capture_us = 0;  ///< increases strictly
};

struct ImageFolder {
  std::vector<FolderImage> images;
  std::vector<std::string> notes;  ///< sentences for the user: source of the times, gaps
};

struct ImageFolderOptions {
  std::filesystem::path folder;
  double rate_hz = 0.0;         ///< 0: not stated
  std::filesystem::path times;  ///< empty: times.txt in the folder or beside it, if there is one
};

/// Lists the files that end in jpg, jpeg, png, bmp, pgm, ppm, tif, tiff or webp, in upper or lower
/// case.
[[nodiscard]] ImageFolder list_image_folder(const ImageFolderOptions& options);

}  // namespace plumb
