/// PNG files of a KITTI camera as 8-bit grey.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

namespace plumb {

struct PngHeader {
  int width_px = 0;
  int height_px = 0;
  int bits_per_channel = 0;
  bool colour = false;  ///< anything but plain grey: RGB, palette, alpha
};

/// Null, and `header` filled, when `bytes` are a PNG with all its chunks; else why not. libpng
/// alone would fill what is cut off with black and call it a warning.
[[nodiscard]] const char* read_png_header(std::span<const std::uint8_t> bytes, PngHeader* header);

/// Grey pixels of `path`. Colour is converted (luma of BT.601) when `colour_allowed`. Throws
/// InputError for files that cannot be read, are cut off or corrupt, have not 8 bits per channel,
/// or are in colour.
[[nodiscard]] cv::Mat load_grey_png(const std::filesystem::path& path, bool colour_allowed);

}  // namespace plumb
