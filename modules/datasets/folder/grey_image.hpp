/// Reads an image file of any usual format as 8-bit grey.
///
/// Formats:
///   Those of OpenCV, told apart by the first bytes of the file, whatever its name is.
/// Errors:
///   Damage that the libraries fill with grey or black and only warn of is an error, too: a PNG or
///   a JPEG without its end.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

namespace plumb {

/// Reads the grey pixels of `path`, upright as its EXIF data say. Colour becomes luma (BT.601).
/// Throws InputError for a file that cannot be read, is cut off or corrupt, or has more than 8 bits
/// per channel.
[[nodiscard]] cv::Mat load_grey_image(const std::filesystem::path& path);

}  // namespace plumb
