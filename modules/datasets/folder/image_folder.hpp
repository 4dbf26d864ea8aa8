/// Lists the images of a folder in order of time, whatever they are called.
///
/// Order:
///   That of the names, in which numbers compare by their value: frame_9 is before frame_10. Names
///   that are times are in the order of the times.
/// Number:
///   The number in the name, when the names differ in nothing else. Missing numbers leave a gap.
///   Numbers that all are multiples of n apart are divided by n. Otherwise the images are
///   consecutive, from 0.
/// Time:
///   1. A stated rate: the number of frames since the first, divided by it.
///   2. A file of times [s]: one row per image, or one per number in the names, as KITTI has them.
///   3. The names, when all of them end in a time (image_name.hpp).
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

/// True for names that end in jpg, jpeg, png, bmp, pgm, ppm, tif, tiff or webp, in either case, and
/// do not begin with a point.
[[nodiscard]] bool is_image_name(const std::filesystem::path& path);

/// Lists the files that have the name of an image. Reads no image.
[[nodiscard]] ImageFolder list_image_folder(const ImageFolderOptions& options);

}  // namespace plumb
